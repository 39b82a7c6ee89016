// Boundary loops of a triangle list.
#pragma once

#include "base/types.h"

namespace fairing {

// The closed loops of border edges, each in the direction of its triangles (the mesh on the left), starting at its
// smallest vertex; ordered by that vertex. At a vertex where several loops touch, each pass leaves through the fan
// of triangles that it came along. Throws NONMANIFOLD_EDGE at edges with more than two triangles, NOT_ORIENTABLE.
std::vector<Indices> boundary_loops(const Triangles& triangles, int vertex_count);

}  // namespace fairing
