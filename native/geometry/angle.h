// The angle between two vectors.
#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/types.h"

namespace fairing {

// 0 … π, accurate for small angles too; 0 where a vector has no length.
inline double radians_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

inline double degrees_between(const Vector3& a, const Vector3& b) {
    return radians_between(a, b) * 180.0 / std::numbers::pi;
}

}  // namespace fairing
