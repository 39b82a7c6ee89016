// Surfaces whose own shape is no texture to keep: a vertex was pulled far out, or all of it is crumpled.
#pragma once

#include "base/types.h"

namespace fairing {

// How far each vertex is from the mean of its neighbours, in mean lengths of the edges opposite to it; 0 in no
// triangle, and where these edges have no length.
VectorX heights(const Points& points, const Triangles& triangles);

// Whether a vertex that only triangles inside have is higher than `spike`, or whether the median of these is above
// `crumpled` and `rougher` times that of the vertices around, those within four rings of the boundary (shape/limits).
bool is_spoilt(const Points& points, const Triangles& inside, const Triangles& outside);

}  // namespace fairing
