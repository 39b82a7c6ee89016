// A first surface over outlines that have none yet.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Outlines with the normals wanted there, in units of D, and a triangulation of what they bound.
struct OpenOutline {
    Points points;        // 3 × vertices, all on the outline
    Points normals;       // unit
    Triangles triangles;  // fill/joined_loops
};

// A mesh of the engine's own with the surface on it. Fixed vertices: the outline's, in their order.
struct FirstSurface {
    Patch patch;
    Solution solution;
};

// Some 300 free vertices or more, and the surface of the equation as `method` finds it there. Throws Cancelled,
// SolverError.
FirstSurface first_surface(const OpenOutline& outline, const SolverOptions& options, const Progress& progress);

}  // namespace fairing
