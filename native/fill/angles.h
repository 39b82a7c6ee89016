// Angles of single triangles, in degrees.
#pragma once

#include "geometry/triangle.h"

namespace fairing {

inline double angle_at(const Vector3& corner, const Vector3& a, const Vector3& b) {
    return degrees_between(a - corner, b - corner);
}

inline double least_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double first = angle_at(a, b, c);
    const double second = angle_at(b, c, a);
    return std::min({first, second, 180.0 - first - second});
}

}  // namespace fairing
