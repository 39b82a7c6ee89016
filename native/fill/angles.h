// Angles of single triangles, in degrees.
#pragma once

#include <algorithm>

#include "geometry/angle.h"

namespace fairing {

constexpr double sharp_corner = 75.0;  // degrees between edges that stay: below, it is one triangle

inline double angle_at(const Vector3& corner, const Vector3& a, const Vector3& b) {
    return degrees_between(a - corner, b - corner);
}

inline double least_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double first = angle_at(a, b, c);
    const double second = angle_at(b, c, a);
    return std::min({first, second, 180.0 - first - second});
}

// Whether an angle of the triangle may be below that of this cosine, an angle below 90°; without arc tangents.
inline bool may_be_sharper(const Vector3& a, const Vector3& b, const Vector3& c, double cosine) {
    const Vector3 ab = b - a;
    const Vector3 ac = c - a;
    const Vector3 bc = c - b;
    const auto is_sharp = [cosine](double product, double squares) {
        return product > 0.0 && product * product >= cosine * cosine * squares;
    };
    const double ab2 = ab.squaredNorm();
    const double ac2 = ac.squaredNorm();
    const double bc2 = bc.squaredNorm();
    return !(ab2 > 0.0 && ac2 > 0.0 && bc2 > 0.0) || is_sharp(ab.dot(ac), ab2 * ac2) ||
           is_sharp(-ab.dot(bc), ab2 * bc2) || is_sharp(ac.dot(bc), ac2 * bc2);
}

}  // namespace fairing
