#include "method/girths.h"

#include <utility>

namespace fairing {

namespace {

VectorX between_ends(const VectorX& lengths) {
    return VectorX::LinSpaced(lengths.size(), lengths[0], lengths[lengths.size() - 1]);
}

void append(const Indices& more, Indices& all) { all.insert(all.end(), more.begin(), more.end()); }

}  // namespace

std::optional<Girths> Girths::of(const Patch& patch, const Points& before, const Progress& progress) {
    auto sections = CrossSections::of(patch, progress);
    if (!sections) return std::nullopt;
    Girths result(std::move(*sections));
    for (int k = 0; k < result.sections_.outline_count(); ++k) {
        const VectorX own = result.sections_.lengths(k, before);
        const VectorX expected = between_ends(own);
        result.lesser_.emplace_back(own.cwiseMin(expected));
        result.larger_.emplace_back(own.cwiseMax(expected));
    }
    return result;
}

Indices Girths::narrow(const Points& points, double share) const {
    Indices triangles;
    for (int k = 0; k < sections_.outline_count(); ++k) {
        const VectorX lengths = sections_.lengths(k, points);
        for (int line = 0; line < lengths.size(); ++line) {
            if (lengths[line] < share * lesser_[at(k)][line]) append(sections_.triangles(k, line), triangles);
        }
    }
    return triangles;
}

Indices Girths::wide(const Points& points, double times) const {
    Indices triangles;
    for (int k = 0; k < sections_.outline_count(); ++k) {
        const VectorX lengths = sections_.lengths(k, points);
        for (int line = 0; line < lengths.size(); ++line) {
            if (lengths[line] > times * larger_[at(k)][line]) append(sections_.triangles(k, line), triangles);
        }
    }
    return triangles;
}

}  // namespace fairing
