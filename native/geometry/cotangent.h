// The cotangent of an angle between two edges, finite for any finite edges.
#pragma once

#include <algorithm>

#include <Eigen/Geometry>

#include "base/types.h"

namespace fairing {

// A sine below this part of the longest edge squared counts as that: the cotangent of a degenerate triangle stays a
// number that does not drown its neighbours'.
constexpr double least_twice_area = 1e-12;
// Of an edge where values are continued harmonically: with those of obtuse angles, which are less, they would
// overshoot.
constexpr double least_harmonic_weight = 1e-3;

// |a × b| of two edges of a triangle, bounded from below; `longest_squared`: of these edges.
inline double safe_twice_area(double twice_area, double longest_squared) {
    return std::max({twice_area, least_twice_area * longest_squared, 1e-300});
}

// ⟨a, b⟩ / |a × b|; 0 where an edge has no length.
inline double cotangent(const Vector3& a, const Vector3& b) {
    return a.dot(b) / safe_twice_area(a.cross(b).norm(), std::max(a.squaredNorm(), b.squaredNorm()));
}

}  // namespace fairing
