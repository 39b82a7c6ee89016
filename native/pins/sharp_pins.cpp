#include "pins/sharp_pins.h"

#include <Eigen/Geometry>

#include "pins/spread_pins.h"

namespace fairing {

namespace {

// Of the normals around a tip to its axis, their mean by area; cos 60°. Hills that rise by half of D have .87 with 400
// and more vertices, and .53 with 100.
constexpr double sharp = 0.5;

double mean_cosine(const Patch& patch, const Points& points, int v) {
    const std::span<const int> around = patch.ring(v).vertices;
    Vector3 sum = Vector3::Zero();
    double area = 0.0;
    for (std::size_t k = 0; k < around.size(); ++k) {
        const Vector3 a = points.col(around[k]) - points.col(v);
        const Vector3 b = points.col(around[(k + 1) % around.size()]) - points.col(v);
        const Vector3 face = a.cross(b);
        sum += face;
        area += face.norm();
    }
    return sum.norm() / area;
}

}  // namespace

Indices sharp_pins(const Patch& patch, const Points& points) {
    Indices places = isolated_pins(patch);
    std::erase_if(places, [&](int place) { return !(mean_cosine(patch, points, patch.free_count + place) < sharp); });
    return places;
}

}  // namespace fairing
