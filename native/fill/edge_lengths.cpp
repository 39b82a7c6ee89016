#include "fill/edge_lengths.h"

#include "base/progress.h"
#include "fairness/harmonic_values.h"
#include "geometry/face_geometry.h"
#include "mesh/nearest_first.h"

namespace fairing {

namespace {

constexpr double usual_growth = 0.5;  // of lengths by distance
constexpr double steep_growth = 1.0;  // where the boundary is so coarse that the usual one gives too few vertices
// Beside an edge of any length the wanted one is reached at half of the edge: where the next vertex is as near.
constexpr double steepest_growth = 2.0;

// Mean length of the edges that stay at each vertex that has any, zero elsewhere.
VectorX border_lengths(const Patch& patch, const Points& points, const KeptEdges& kept) {
    VectorX lengths = VectorX::Zero(patch.vertex_count());
    VectorX counts = VectorX::Zero(patch.vertex_count());
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[e][1] != none && (kept.empty() || kept[e] == 0)) continue;
        const auto [a, b] = patch.edge_ends[e];
        for (const int v : {a, b}) {
            lengths[v] += (points.col(a) - points.col(b)).norm();
            counts[v] += 1.0;
        }
    }
    return lengths.cwiseQuotient(counts.cwiseMax(1.0));
}

// The mean over the edges of the border; 0 without one.
double mean_border_edge(const Patch& patch, const Points& points) {
    double length = 0.0;
    double count = 0.0;
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[e][1] != none) continue;
        const auto [a, b] = patch.edge_ends[e];
        length += (points.col(a) - points.col(b)).norm();
        count += 1.0;
    }
    return length / std::max(count, 1.0);
}

// exp of the harmonic continuation of the border's log lengths.
VectorX continued(const Patch& patch, const Points& points, const VectorX& border) {
    double sum = 0.0;
    Eigen::Index count = 0;
    VectorX logarithms = VectorX::Zero(patch.vertex_count());
    for (int v = 0; v < patch.vertex_count(); ++v) {
        if (border[v] <= 0.0) continue;
        sum += logarithms[v] = std::log(border[v]);
        ++count;
    }
    const double mean = count > 0 ? sum / static_cast<double>(count) : 0.0;
    for (int v = 0; v < patch.vertex_count(); ++v) {
        if (border[v] <= 0.0) logarithms[v] = mean;  // pins, too
    }
    const auto fixed_count = patch.vertex_count() - patch.free_count;
    const auto inside = harmonic_values(patch, points, logarithms.tail(fixed_count));
    if (inside) logarithms.head(patch.free_count) = inside->col(0);
    return logarithms.array().exp();
}

// Makes every length at most (or, with `sign` −1, at least) that of a neighbour plus (minus) `growth` times the
// distance.
void grade(const Patch& patch, const Points& points, double growth, double sign, VectorX& lengths) {
    NearestFirst reached(VectorX::Constant(lengths.size(), std::numeric_limits<double>::infinity()));
    for (int v = 0; v < patch.vertex_count(); ++v) reached.lower(v, sign * lengths[v]);
    for (int v = reached.next(); v != none; v = reached.next()) {
        for (const int u : patch.ring(v).vertices)
            reached.lower(u, reached[v] + growth * (points.col(u) - points.col(v)).norm());
    }
    lengths = sign * std::move(reached).take();
}

// The boundary's edges stay: where they are longer than wanted, lengths shrink inwards, and
// grow where they are shorter.
VectorX graded(const Patch& patch, const Points& points, double growth, const VectorX& border, const VectorX& inside) {
    VectorX lengths = inside;
    const auto hold = [&] {
        for (int v = 0; v < patch.vertex_count(); ++v) {
            if (border[v] > 0.0) lengths[v] = border[v];
        }
    };
    for (int v = 0; v < patch.vertex_count(); ++v) {
        if (border[v] > 0.0) lengths[v] = std::min(border[v], inside[v]);
    }
    grade(patch, points, growth, 1.0, lengths);
    hold();
    grade(patch, points, growth, -1.0, lengths);
    return lengths;
}

// The least growth with which the boundary's long edges leave most of the inside the lengths wanted there.
double enough_growth(const Patch& patch, const Points& points, const VectorX& border, const VectorX& inside) {
    constexpr double most = 0.5;  // of the vertices
    const double count = expected_count(patch, points, inside);
    for (const double growth : {usual_growth, steep_growth}) {
        if (expected_count(patch, points, graded(patch, points, growth, border, inside)) >= most * count) return growth;
    }
    return steepest_growth;
}

// Those wanted away from all that stays.
VectorX lengths_inside(const Patch& patch, const Points& points, const WantedLengths& wanted, const VectorX& border) {
    if (wanted.each.size() > 0) return wanted.each;
    const double mean = mean_border_edge(patch, points);
    const bool has_scale = mean > 0.0 && wanted.spacing > 0.0;
    if (wanted.spread == Spread::boundary && (has_scale || wanted.spacing <= 0.0))
        return (has_scale ? wanted.spacing / mean : 1.0) * continued(patch, points, border);
    const double same = wanted.spacing > 0.0 ? wanted.spacing : mean;
    if (same > 0.0) return VectorX::Constant(patch.vertex_count(), same);
    return continued(patch, points, border);
}

}  // namespace

double expected_count(const Patch& patch, const Points& points, const VectorX& lengths) {
    FaceGeometry faces(points, patch.triangles);
    double count = 0.0;
    for (int t = 0; t < patch.triangle_count(); ++t) {
        double inverse = 0.0;
        for (const int v : patch.triangles.col(t)) inverse += 1.0 / (3.0 * lengths[v] * lengths[v]);
        count += vertices_per_square * faces.areas[t] * inverse;
    }
    return count;
}

VectorX edge_lengths(const Patch& patch, const Points& points, const WantedLengths& wanted, const KeptEdges& kept) {
    constexpr int halvings = 12;             // of a range of 100: to a thousandth
    constexpr double smallest_scale = 1e-2;  // of the wanted lengths
    const VectorX border = border_lengths(patch, points, kept);
    const VectorX inside = lengths_inside(patch, points, wanted, border);
    const double growth = enough_growth(patch, points, border, inside);
    VectorX lengths = graded(patch, points, growth, border, inside);
    const auto suffices = [&](const VectorX& tried) {
        return expected_count(patch, points, tried) >= wanted.least_count;
    };
    if (suffices(lengths)) return lengths;
    for (const double steeper : {growth, std::max(growth, steep_growth)}) {
        double enough = smallest_scale;
        double few = 1.0;
        lengths = graded(patch, points, steeper, border, enough * inside);
        if (!suffices(lengths)) continue;
        for (int k = 0; k < halvings; ++k) {
            const double scale = std::sqrt(enough * few);
            VectorX tried = graded(patch, points, steeper, border, scale * inside);
            if (suffices(tried)) {
                enough = scale;
                lengths = std::move(tried);
            } else {
                few = scale;
            }
        }
        break;
    }
    return lengths;
}

}  // namespace fairing
