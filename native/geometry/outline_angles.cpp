#include "geometry/outline_angles.h"

#include <algorithm>

#include "geometry/angle.h"

namespace fairing {

namespace {

bool touches_free(const Patch& patch, int vertex) {
    const auto ring = patch.ring(vertex).vertices;
    return std::any_of(ring.begin(), ring.end(), [&](int v) { return patch.is_free(v); });
}

}  // namespace

VectorX boundary_angles(const Patch& patch, const Points& actual, const Points& prescribed) {
    VectorX angles = VectorX::Zero(prescribed.cols());
    for (int k = 0; k < prescribed.cols(); ++k) {
        const int v = patch.free_count + k;
        if (patch.pin[v] || !touches_free(patch, v)) continue;
        angles[k] = degrees_between(prescribed.col(k), actual.col(k));
    }
    return angles;
}

}  // namespace fairing
