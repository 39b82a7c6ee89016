#include "method/girths.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace fairing {

namespace {

VectorX between_ends(const VectorX& lengths) {
    return VectorX::LinSpaced(lengths.size(), lengths[0], lengths[lengths.size() - 1]);
}

// Triangles of the cross-sections whose length stands in some relation to what is expected, for each outline.
template <typename Stands>
Indices triangles_where(const CrossSections& sections, const Points& points, const std::vector<VectorX>& expected,
                        const Stands& stands) {
    Indices triangles;
    for (int k = 0; k < sections.outline_count(); ++k) {
        const VectorX lengths = sections.lengths(k, points);
        for (int line = 0; line < lengths.size(); ++line) {
            if (!stands(lengths[line], expected[at(k)][line])) continue;
            const Indices found = sections.triangles(k, line);
            triangles.insert(triangles.end(), found.begin(), found.end());
        }
    }
    return triangles;
}

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
        result.radii_.emplace_back(own / (2.0 * std::numbers::pi));
        result.middles_.push_back(result.sections_.middles(k, before));
    }
    return result;
}

Indices Girths::narrow(const Points& points, double share) const {
    return triangles_where(sections_, points, lesser_,
                           [&](double found, double lesser) { return found < share * lesser; });
}

Indices Girths::wide(const Points& points, double times) const {
    return triangles_where(sections_, points, larger_,
                           [&](double found, double larger) { return found > times * larger; });
}

double Girths::aside(const Points& points) const {
    double farthest = 0.0;
    for (int k = 0; k < sections_.outline_count(); ++k) {
        const VectorX away = (sections_.middles(k, points) - middles_[at(k)]).colwise().norm().transpose();
        farthest = std::max(farthest, away.cwiseQuotient(radii_[at(k)]).maxCoeff());
    }
    return farthest;
}

}  // namespace fairing
