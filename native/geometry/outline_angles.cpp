#include "geometry/outline_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace fairing {

namespace {

bool touches_free(const Patch& patch, int vertex) {
    const auto ring = patch.ring(vertex).vertices;
    return std::any_of(ring.begin(), ring.end(), [&](int v) { return patch.is_free(v); });
}

}  // namespace

double degrees_between(const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

VectorX boundary_angles(const Patch& patch, const Points& actual, const Points& prescribed) {
    VectorX angles = VectorX::Zero(prescribed.cols());
    for (int k = 0; k < prescribed.cols(); ++k) {
        const int v = patch.free_count + k;
        if (patch.pin[at(v)] || !touches_free(patch, v)) continue;
        angles[k] = degrees_between(prescribed.col(k), actual.col(k));
    }
    return angles;
}

}  // namespace fairing
