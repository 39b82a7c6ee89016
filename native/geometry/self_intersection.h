// Triangles of a surface that cross each other.
#pragma once

#include "base/types.h"

namespace fairing {

// Numbers of the triangles, ascending, that another one pierces: an edge of one passes through the inside of the other.
// Triangles that share an edge don't count (a fold), nor do those that only touch or overlap in one plane.
// O(n log n) for surfaces with few crossings.
Indices crossing_triangles(const Triangles& triangles, const Points& points);

// Only pairs that contain one of the triangles `few`: the numbers of both, ascending. One box test for each of the
// other triangles.
Indices crossings_with(const Triangles& triangles, const Points& points, const Indices& few);

}  // namespace fairing
