#include "method/girths.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace fairing {

namespace {

// π times the width over the length: 1 for circles, π / 2 at most. Ellipses of 2.3 : 1 have as much; wings had 1.33 to
// 1.43, a head between an eye and the neck 1.31.
constexpr double least_flatness = 1.33;

VectorX between_ends(const VectorX& lengths) {
    return VectorX::LinSpaced(lengths.size(), lengths[0], lengths[lengths.size() - 1]);
}

// Triangles of the cross-sections of an outline that stand in some relation to what is expected.
template <typename Stands>
void add_where(const CrossSections& sections, int outline, const VectorX& found, const VectorX& expected,
               const Stands& stands, Indices& triangles) {
    for (int line = 0; line < found.size(); ++line) {
        if (!stands(found[line], expected[line])) continue;
        const Indices more = sections.triangles(outline, line);
        triangles.insert(triangles.end(), more.begin(), more.end());
    }
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
        const VectorX wide = result.sections_.widths(k, before);
        const auto is_flat = wide.array() * std::numbers::pi > least_flatness * own.array();
        result.slimmer_.emplace_back(is_flat.select(wide.cwiseMin(between_ends(wide)), 0.0));
    }
    return result;
}

Indices Girths::narrow(const Points& points, double share) const {
    const auto is_less = [&](double found, double lesser) { return found < share * lesser; };
    Indices triangles;
    for (int k = 0; k < sections_.outline_count(); ++k)
        add_where(sections_, k, sections_.lengths(k, points), lesser_[k], is_less, triangles);
    return triangles;
}

Indices Girths::slim(const Points& points, double share) const {
    const auto is_less = [&](double found, double slimmer) { return found < share * slimmer; };
    Indices triangles;
    for (int k = 0; k < sections_.outline_count(); ++k)
        add_where(sections_, k, sections_.widths(k, points), slimmer_[k], is_less, triangles);
    return triangles;
}

Indices Girths::wide(const Points& points, double times) const {
    const auto is_more = [&](double found, double larger) { return found > times * larger; };
    Indices triangles;
    for (int k = 0; k < sections_.outline_count(); ++k)
        add_where(sections_, k, sections_.lengths(k, points), larger_[k], is_more, triangles);
    return triangles;
}

}  // namespace fairing
