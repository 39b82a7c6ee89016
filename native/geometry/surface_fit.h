// Normals from a polynomial surface fitted to nearby points: for outlines, where the one-ring sees one side only.
#pragma once

#include <optional>
#include <span>

#include "mesh/patch.h"

namespace fairing {

// Unit normal at `centre` of the height polynomial through it that fits `points` best (Gaussian weights, tangent frame
// iterated); cubic from 16 points on, quadratic from 8. Exact on spheres. Nothing where there are fewer, where they
// turn too far away from `start`, or where they don't determine the polynomial. Same side as `start`.
std::optional<Vector3> surface_fit_normal(const Vector3& centre, std::span<const Vector3> points, const Vector3& start);

// Normals at the fixed vertices (3 × fixed count) fitted to the patch's own side of the outline; averaged ones where
// the fit has too few points.
Points one_sided_normals(const Patch& patch, const Points& points);

struct SurroundingNormals {
    Points normals;            // 3 × k, unit; zero where there is no triangle
    std::vector<char> fitted;  // 0: averaged, for want of points
};

// Normals at `vertices` of the surface formed by `triangles` alone (the surroundings of a patch).
SurroundingNormals surrounding_normals(const Points& points, const Triangles& triangles, const Indices& vertices);

}  // namespace fairing
