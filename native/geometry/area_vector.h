// Twice the area of a triangle along its normal.
#pragma once

#include <Eigen/Geometry>

#include "base/types.h"

namespace fairing {

inline Vector3 area_vector(const Vector3& a, const Vector3& b, const Vector3& c) { return (b - a).cross(c - a); }

// `corners`: three columns of `points`.
template <typename Corners>
Vector3 area_vector(const Points& points, const Corners& corners) {
    return area_vector(Vector3(points.col(corners[0])), points.col(corners[1]), points.col(corners[2]));
}

}  // namespace fairing
