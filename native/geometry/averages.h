// Means over a mesh.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// At each vertex the sum of the triangles' cross products, of unit length (3 × points; zero where there is none).
Points averaged_normals(const Points& points, const Triangles& triangles);

// Mean length of a patch's edges.
double mean_edge(const Patch& patch, const Points& points);

// Of those at one vertex.
double mean_spoke(const Patch& patch, const Points& points, int vertex);

}  // namespace fairing
