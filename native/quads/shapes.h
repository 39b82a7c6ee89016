// How far quads are from squares, and steps that bring them there.
#pragma once

#include "quads/layout.h"

namespace fairing {

inline constexpr double most_wide = 175.0;  // degrees: short of a quad that is not convex

inline bool is_unfit(double angle) { return angle < 50.0 || angle > 130.0; }

template <typename Face>
Vector3 normal_at(const Face& face, const Points& normals) {
    Vector3 sum = Vector3::Zero();
    for (const int v : face) sum += normals.col(v);
    return sum.normalized();
}

// Degrees from the edge to `next` counter-clockwise to that to `last`, 0 … 360, seen from where the normal points.
double angle_of_corner(const Vector3& last, const Vector3& here, const Vector3& next, const Vector3& normal);

// From a right angle, in units of 45°.
double angle_error(double angle);

// Of all quads of a pattern at these places; `normals` of the surface there tell what is turned over. `length`: that of
// a good edge.
QuadShapes shapes_of(const QuadPattern& pattern, const Points& points, const Points& normals, double length);

// Where vertices go so that quads become squares, or rectangles at least: the mean of the places that the nearest ones
// around give them (Bouaziz et al. 2012, shape constraints). Each step goes on by some of the last one.
class SquareSteps {
public:
    explicit SquareSteps(const QuadPattern& pattern) : pattern_(pattern) {}
    // New places; those of the boundary are as they were.
    Points wanted(const Points& points, const Points& normals);

private:
    const QuadPattern& pattern_;
    Points last_;
};

}  // namespace fairing
