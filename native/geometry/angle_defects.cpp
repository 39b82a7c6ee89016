#include "geometry/angle_defects.h"

#include <algorithm>
#include <numbers>

#include "base/parallel.h"
#include "geometry/angle.h"

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

}  // namespace

VectorX angle_defects(const Patch& patch, const Points& points) {
    VectorX defects = VectorX::Zero(patch.vertex_count());
    for_ranges(patch.free_count, fine_grain, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) defects[v] = 2.0 * std::numbers::pi - angle_around(patch, points, v);
    });
    return defects;
}

}  // namespace fairing
