#include "continuity/known_curvature.h"

#include "geometry/limits.h"
#include "geometry/triangle.h"
#include "operators/boundary_system.h"

namespace fairing {

namespace {

// Lengths of the edges from each vertex to the next one; on an open curve the last one repeats.
VectorX edge_lengths(const BoundaryCurve& curve, const Points& points) {
    const auto count = static_cast<Eigen::Index>(curve.places.size());
    VectorX lengths(count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const Eigen::Index next = (k + 1) % count;
        lengths[k] = (points.col(curve.places[std::size_t(next)]) - points.col(curve.places[std::size_t(k)])).norm();
    }
    if (!curve.closed) lengths[count - 1] = lengths[std::max<Eigen::Index>(count - 2, 0)];
    return lengths.cwiseMax(1e-9 * lengths.maxCoeff() + 1e-300);
}

// Means with the neighbours along the curve.
VectorX evened(VectorX values, bool closed) {
    const Eigen::Index count = values.size();
    for (int sweep = 0; sweep < smoothing_sweeps; ++sweep) {
        const VectorX old = values;
        for (Eigen::Index k = 0; k < count; ++k) {
            const Eigen::Index before = k > 0 ? k - 1 : (closed ? count - 1 : k);
            const Eigen::Index after = k + 1 < count ? k + 1 : (closed ? 0 : k);
            values[k] = 0.25 * old[before] + 0.5 * old[k] + 0.25 * old[after];
        }
    }
    return values;
}

// Vertices from the first one, counted by length over spacing.
VectorX parameters(const VectorX& lengths, const VectorX& spacing) {
    VectorX t = VectorX::Zero(lengths.size());
    for (Eigen::Index k = 1; k < t.size(); ++k) t[k] = t[k - 1] + 2.0 * lengths[k - 1] / (spacing[k - 1] + spacing[k]);
    return t;
}

// The nearest place in that direction that is not skipped, as its value and how far it is; infinitely far where there
// is none.
std::pair<double, double> nearest(const BoundaryCurve& curve, const VectorX& given, int place, int direction) {
    const auto count = static_cast<int>(curve.places.size());
    for (int away = 1; away < count; ++away) {
        const int there = place + direction * away;
        if (!curve.closed && (there < 0 || there >= count)) break;
        const int k = (there + count) % count;
        if (!curve.skipped[k]) return {given[k], away};
    }
    return {0.0, HUGE_VAL};
}

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
void split(const Indices& loop, const VectorX& curvatures, std::vector<BoundaryCurve>& curves) {
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

VectorX values_along(const BoundaryCurve& curve, const VectorX& values) {
    const VectorX given = values(curve.places);
    if (curve.skipped.empty()) return given;
    VectorX result = given;
    for (int k = 0; k < static_cast<int>(given.size()); ++k) {
        if (!curve.skipped[k]) continue;
        const auto [before, back] = nearest(curve, given, k, -1);
        const auto [after, on] = nearest(curve, given, k, 1);
        const double weight = 1.0 / back + 1.0 / on;
        result[k] = weight > 0.0 ? (before / back + after / on) / weight : 0.0;
    }
    return result;
}

BoundaryModes::BoundaryModes(const std::vector<BoundaryCurve>& curves, const Points& fixed_points,
                             int vertices_per_wave)
    : fixed_count_(fixed_points.cols()) {
    for (const BoundaryCurve& curve : curves) add_curve(curve, fixed_points, vertices_per_wave);
}

void BoundaryModes::add_curve(const BoundaryCurve& curve, const Points& fixed_points, int vertices_per_wave) {
    const auto vertices = static_cast<Eigen::Index>(curve.places.size());
    const VectorX lengths = edge_lengths(curve, fixed_points);
    const VectorX spacing = evened(lengths, curve.closed);
    const VectorX t = parameters(lengths, spacing);
    // Once around, or from just before the first vertex to just after the last one.
    const double period = t[vertices - 1] + (curve.closed ? lengths[vertices - 1] / spacing[vertices - 1] : 2.0);
    const Eigen::Index pairs = vertices / vertices_per_wave;
    const Eigen::Index waves = curve.closed ? 1 + 2 * pairs : std::max<Eigen::Index>(1, 2 * pairs);
    Curve made{curve, Eigen::MatrixXd(vertices, waves), VectorX(waves), spacing.cwiseAbs2().cwiseInverse()};
    const double slowest = 2.0 * std::numbers::pi / period;
    for (Eigen::Index m = 0; m < waves; ++m) {
        const Eigen::Index halves = curve.closed ? m + m % 2 : m + 1;  // half waves on the curve
        const double frequency = 0.5 * slowest * static_cast<double>(halves);
        const bool cosine = curve.closed && m % 2 == 0;
        if (cosine) {
            made.waves.col(m) = (frequency * t.array()).cos();
        } else {
            made.waves.col(m) = (frequency * (t.array() + (curve.closed ? 0.0 : 1.0))).sin();
        }
        made.waves.col(m).normalize();
        made.symbol[m] = 8.0 * (frequency + slowest) * (frequency + 2.0 * slowest);
    }
    count_ += waves;
    curves_.push_back(std::move(made));
}

VectorX BoundaryModes::combined(const VectorX& coefficients) const {
    VectorX values = VectorX::Zero(fixed_count_);
    Eigen::Index first = 0;
    for (const Curve& curve : curves_) {
        values(curve.boundary.places) += curve.waves * coefficients.segment(first, curve.waves.cols());
        first += curve.waves.cols();
    }
    return values;
}

VectorX BoundaryModes::projected(const VectorX& values) const {
    VectorX coefficients(count_);
    Eigen::Index first = 0;
    for (const Curve& curve : curves_) {
        coefficients.segment(first, curve.waves.cols()) =
            curve.waves.transpose() * values_along(curve.boundary, values);
        first += curve.waves.cols();
    }
    return coefficients;
}

VectorX BoundaryModes::multipliers(const VectorX& coefficients) const {
    VectorX values = VectorX::Zero(fixed_count_);
    Eigen::Index first = 0;
    for (const Curve& curve : curves_) {
        const VectorX weighed = curve.symbol.cwiseProduct(coefficients.segment(first, curve.waves.cols()));
        values(curve.boundary.places) += curve.inverse_square.cwiseProduct(curve.waves * weighed);
        first += curve.waves.cols();
    }
    return values;
}

VectorX KnownCurvature::missing(const VectorX& curvatures) const {
    VectorX result = VectorX::Zero(curvatures.size());
    for (const BoundaryCurve& curve : curves) result(curve.places) = values_along(curve, values - curvatures);
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
    for (BoundaryCurve& curve : known.curves) {
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
