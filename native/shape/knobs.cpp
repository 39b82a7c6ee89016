#include "shape/knobs.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "geometry/angle.h"
#include "shape/limits.h"

namespace fairing {

namespace {

double angle_around(const Patch& patch, const Points& points, int vertex) {
    const RingView ring = patch.ring(vertex);
    const Vector3 here = points.col(vertex);
    double sum = 0.0;
    for (std::size_t k = 0; k < ring.rim.size(); ++k) {
        const int next = ring.vertices[k + 1 == ring.valence() ? 0 : k + 1];
        sum += radians_between(points.col(ring.vertices[k]) - here, points.col(next) - here);
    }
    return sum;
}

// 2π minus the angles around each free vertex: the integral of its Gaussian curvature.
VectorX angle_defects(const Patch& patch, const Points& points) {
    VectorX defects(patch.free_count);
    for_ranges(patch.free_count, fine_grain, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) defects[v] = full_turn - angle_around(patch, points, v);
    });
    return defects;
}

// The most bent vertices, until their sum is reached.
Indices most_bent(const VectorX& defects, double sum) {
    Indices order(static_cast<std::size_t>(defects.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return defects[a] > defects[b]; });
    std::size_t count = 0;
    for (double reached = 0.0; reached < sum && count < order.size(); ++count) reached += defects[order[count]];
    order.resize(count);
    return order;
}

}  // namespace

bool is_plain_disc(const Patch& patch) {
    return !patch.has_pins() && patch.vertex_count() - patch.edge_count() + patch.triangle_count() == 1;
}

Knobs knobs_of(const Patch& patch, const Points& points, double before) {
    if (!is_plain_disc(patch)) return {};
    const VectorX defects = angle_defects(patch, points);
    const double ball = defects.cwiseMax(0.0).sum();
    const double saddle = -defects.cwiseMin(0.0).sum();
    Knobs knobs{std::min(ball, saddle) / full_turn, {}};
    if (knobs.extent > std::max(least_knob, calmer * before)) knobs.tops = most_bent(defects, 0.5 * ball);
    return knobs;
}

}  // namespace fairing
