// Triangles that are turned over against those around them.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Local numbers, ascending, of the triangles whose normal points against the mean of Max's normals at their corners.
// `points`: 3 × local vertices.
Indices flipped_triangles(const Patch& patch, const Points& points);

// The same without those that have no free corner: the boundary alone turns them, no solution can turn them back.
Indices flipped_by_solution(const Patch& patch, const Points& points);

// Whether one triangle is.
bool is_flipped(const Patch& patch, const Points& points, int triangle);

}  // namespace fairing
