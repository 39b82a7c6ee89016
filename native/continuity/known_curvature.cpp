#include "continuity/known_curvature.h"

#include <algorithm>
#include <cmath>

#include "geometry/angle.h"
#include "geometry/limits.h"

namespace fairing {

namespace {

constexpr std::size_t widest_bridge = 3;  // vertices: half a wave of the fastest that is kept

// A loop, turned so that it begins with a known vertex after an unknown one, if it has both.
Indices from_first_arc(Indices places, const VectorX& curvatures) {
    const auto is_known = [&](int place) { return std::isfinite(curvatures[place]); };
    for (std::size_t k = 0; k < places.size(); ++k) {
        const int before = places[(k + places.size() - 1) % places.size()];
        if (is_known(before) || !is_known(places[k])) continue;
        std::rotate(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(k), places.end());
        break;
    }
    return places;
}

// Short gaps between known vertices, by linear interpolation.
void bridge(const Indices& loop, VectorX& curvatures) {
    const std::size_t count = loop.size();
    for (std::size_t k = 0; k < count; ++k) {
        const double here = curvatures[loop[k]];
        if (!std::isfinite(here) || !std::isnan(curvatures[loop[(k + 1) % count]])) continue;
        std::size_t gap = 1;
        while (gap <= widest_bridge && std::isnan(curvatures[loop[(k + 1 + gap) % count]])) ++gap;
        const double there = curvatures[loop[(k + 1 + gap) % count]];
        if (gap > widest_bridge || !std::isfinite(there)) continue;
        for (std::size_t n = 1; n <= gap; ++n) {
            const double share = static_cast<double>(n) / static_cast<double>(gap + 1);
            curvatures[loop[(k + n) % count]] = (1.0 - share) * here + share * there;
        }
    }
}

// The known arcs of a loop that begins with one.
void split(const Indices& loop, const VectorX& curvatures, std::vector<OutlineCurve>& curves) {
    const auto is_known = [&](int place) { return std::isfinite(curvatures[place]); };
    if (std::all_of(loop.begin(), loop.end(), is_known)) {
        curves.push_back({loop, true, {}});
        return;
    }
    for (auto first = loop.begin(); first != loop.end();) {
        const auto last = std::find_if_not(first, loop.end(), is_known);
        if (last - first >= fastest_wave) curves.push_back({Indices(first, last), false, {}});
        first = std::find_if(last, loop.end(), is_known);
    }
}

std::vector<char> corners_of(const Patch& patch, const Points& points) {
    VectorX filled = VectorX::Zero(patch.vertex_count());
    for (const auto t : patch.triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const Vector3 here = points.col(t[k]);
            filled[t[k]] += radians_between(points.col(t[(k + 1) % 3]) - here, points.col(t[(k + 2) % 3]) - here);
        }
    }
    std::vector<char> corner;
    for (int v = patch.free_count; v < patch.vertex_count(); ++v) corner.push_back(filled[v] < widest_corner);
    return corner;
}

}  // namespace

VectorX KnownCurvature::missing(const VectorX& curvatures) const {
    VectorX result = VectorX::Zero(curvatures.size());
    for (const OutlineCurve& curve : curves) result(curve.places) = values_along(curve, values - curvatures);
    return result;
}

KnownCurvature known_curvature(const Patch& patch, const Points& points, const VectorX& curvatures) {
    KnownCurvature known{VectorX::Zero(curvatures.size()), {}, {}};
    const std::vector<char> corners = corners_of(patch, points);
    VectorX filled = curvatures;
    for (Indices loop : patch.loops()) {
        for (int& v : loop) v -= patch.free_count;
        bridge(loop, filled);
        split(from_first_arc(loop, filled), filled, known.curves);
        known.unknown.insert(known.unknown.end(), loop.begin(), loop.end());
    }
    std::vector<char> covered(static_cast<std::size_t>(curvatures.size()), 0);
    for (OutlineCurve& curve : known.curves) {
        for (int place : curve.places) {
            curve.skipped.push_back(corners[place]);
            covered[place] = 1;
            known.values[place] = filled[place];
        }
    }
    std::erase_if(known.unknown, [&](int place) { return covered[place] != 0 || std::isinf(curvatures[place]); });
    std::sort(known.unknown.begin(), known.unknown.end());
    return known;
}

}  // namespace fairing
