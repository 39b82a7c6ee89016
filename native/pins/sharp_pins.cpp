#include "pins/sharp_pins.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "geometry/outline_angles.h"
#include "pins/spread_pins.h"

namespace fairing {

namespace {

// Hills that rise by half of D are at 29° with 400 and more vertices, and at 58° with 100.
constexpr double sharp = 60.0;  // degrees

// Largest angle between a triangle at an inner vertex and the mean, degrees.
double sharpness(const Patch& patch, const Points& points, int v) {
    const std::span<const int> around = patch.ring(v).vertices;
    Points areas(3, static_cast<Eigen::Index>(around.size()));
    for (std::size_t k = 0; k < around.size(); ++k) {
        const Vector3 a = points.col(around[k]) - points.col(v);
        const Vector3 b = points.col(around[(k + 1) % around.size()]) - points.col(v);
        areas.col(static_cast<Eigen::Index>(k)) = a.cross(b);
    }
    const Vector3 mean = areas.rowwise().sum();
    double largest = 0.0;
    for (const auto area : areas.colwise()) largest = std::max(largest, degrees_between(area, mean));
    return largest;
}

}  // namespace

Indices sharp_pins(const Patch& patch, const Points& points) {
    Indices places = isolated_pins(patch);
    std::erase_if(places, [&](int place) { return !(sharpness(patch, points, patch.free_count + place) > sharp); });
    return places;
}

}  // namespace fairing
