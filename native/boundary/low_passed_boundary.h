// Boundary loops too jagged to be met, and the low-passed ones that replace them.
#pragma once

#include "base/types.h"
#include "mesh/patch.h"

namespace fairing {

// Positions of a patch's fixed vertices and unit normals there, each 3 × fixed count.
struct BoundaryData {
    Points points;
    Points normals;
};

// How much any surface with this boundary has to vary: Σ (dκ/ds)² |e|² over the boundary's edges e,
// with dκ/ds = 6 ⟨n_i + n_j, e⟩ / |e|³ along an edge e. Zero for boundary loops on spheres and cylinders; in units of
// length⁻².
double boundary_variation(const Patch& patch, const BoundaryData& boundary);

// The boundary without its short waves: along each loop positions and normals minimise Σ |x − x₀|² + μ Σ |δ²x|², which
// halves waves of `wave` vertices, and normals are then at right angles to it. Loops of no more than `wave` vertices
// and what lies on no loop stay.
BoundaryData low_passed_boundary(const Patch& patch, const BoundaryData& boundary, double wave);

// Puts every vertex that is not `held` at the mean of its neighbours: discs over flat loops are flat.
// Vertices connected to no held one stay.
Points closing_surface(const Points& points, const Triangles& triangles, const std::vector<char>& held);

// Surroundings that are broken along creases.
struct BrokenSurface {
    Triangles triangles;   // of copies
    Indices input_vertex;  // copy → vertex
};

// The triangles taken apart along edges: a vertex has one copy for each fan that is left at it.
// Precondition: three different vertices in each triangle.
BrokenSurface broken_along(const Triangles& triangles, int vertex_count, const std::vector<std::array<int, 2>>& edges);

}  // namespace fairing
