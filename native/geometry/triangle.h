// Angles, areas, cotangents and frames of single triangles.
#pragma once

#include <Eigen/Geometry>

#include "base/types.h"

namespace fairing {

// The angle between two vectors.
inline constexpr double degree = std::numbers::pi / 180.0;   // in radians
inline constexpr double full_turn = 2.0 * std::numbers::pi;  // likewise

// 0 … π, accurate for small angles too; 0 where a vector has no length.
inline double radians_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

inline double degrees_between(const Vector3& a, const Vector3& b) { return radians_between(a, b) / degree; }

// Twice the area of a triangle along its normal.
inline Vector3 area_vector(const Vector3& a, const Vector3& b, const Vector3& c) { return (b - a).cross(c - a); }

// `corners`: three columns of `points`.
template <typename Corners>
Vector3 area_vector(const Points& points, const Corners& corners) {
    return area_vector(Vector3(points.col(corners[0])), points.col(corners[1]), points.col(corners[2]));
}

// The cross product of a triangle is raised to this share of its longest edge squared: the cotangents of a degenerate
// one stay finite, and too small to drown its neighbours'.
constexpr double least_twice_area = 1e-12;
// Least weight of an edge in harmonic interpolation: the negative weights of obtuse angles would overshoot.
constexpr double least_harmonic_weight = 1e-3;

// |a × b| of two edges of a triangle, bounded from below; `longest_squared`: of these edges.
inline double safe_twice_area(double twice_area, double longest_squared) {
    return std::max({twice_area, least_twice_area * longest_squared, 1e-300});
}

// ⟨a, b⟩ / |a × b|; 0 where an edge has no length.
inline double cotangent(const Vector3& a, const Vector3& b) {
    return a.dot(b) / safe_twice_area(a.cross(b).norm(), std::max(a.squaredNorm(), b.squaredNorm()));
}

// An orthonormal basis of the plane across a unit vector.
template <typename Scalar>
struct FrameOf {
    Vector3Of<Scalar> u;
    Vector3Of<Scalar> v;

    // Duff et al. 2017, "Building an orthonormal basis, revisited": no branch that loses accuracy near the poles.
    explicit FrameOf(const Vector3Of<Scalar>& n) {
        using std::copysign;
        const Scalar sign = copysign(Scalar(1.0), n.z());
        const Scalar a = -1.0 / (sign + n.z());
        const Scalar b = n.x() * n.y() * a;
        u = {1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
        v = {b, sign + n.y() * n.y() * a, -n.y()};
    }
};

using Frame = FrameOf<double>;

}  // namespace fairing
