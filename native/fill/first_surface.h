// A first surface over boundary loops.
#pragma once

#include "base/progress.h"
#include "fill/edge_lengths.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Boundary loops with the normals wanted there, in units of D.
struct OpenBoundary {
    Points points;               // 3 × vertices, all on the boundary
    Points normals;              // unit
    std::vector<Indices> loops;  // of vertices, the surface on their left
    EdgeSet taken = {};          // vertices that are joined outside
};

// A mesh of the engine's own with the surface on it. Fixed vertices: the boundary's, in their order.
struct FirstSurface {
    Patch patch;
    Solution solution;
};

// Some 300 free vertices or more, and the surface of the equation as `method` finds it there. Throws Cancelled,
// SolverError, MeshError where no triangulation joins the boundary loops.
FirstSurface first_surface(const OpenBoundary& boundary, const SolverOptions& options, const Progress& progress);

// A coarse and flat mesh; not converged where a ball is the better beginning.
FirstSurface flat_surface(const OpenBoundary& boundary);

}  // namespace fairing
