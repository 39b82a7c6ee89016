// The angle between two vectors.
#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/types.h"

namespace fairing {

inline constexpr double degree = std::numbers::pi / 180.0;   // in radians
inline constexpr double full_turn = 2.0 * std::numbers::pi;  // likewise

// 0 … π, accurate for small angles too; 0 where a vector has no length.
inline double radians_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

inline double degrees_between(const Vector3& a, const Vector3& b) { return radians_between(a, b) / degree; }

}  // namespace fairing
