// First surfaces over boundary loops.
#pragma once

#include "api/fair.h"

namespace fairing {

// Closed loops of vertices, the new surface on their left, with a unit normal for each vertex.
struct OpenLoops {
    Points vertices;
    std::vector<Indices> loops;
    std::vector<Points> normals;  // 3 × size of each loop
};

// A triangle mesh whose first vertices are the caller's, all of them; then come new ones.
struct NewSurface {
    Points vertices;  // the new ones
    Triangles triangles;
    bool converged = true;                         // whether each is the equation's surface,
    Provenance provenance = Provenance::equation;  // where each comes from; `equation` where they differ
};

// One surface over all loops, or one over each. The mesh is coarse (some 300 new vertices each), an initial surface for
// `remesh` and `fair`. Throws SolverError, Cancelled; MeshError (NONMANIFOLD_EDGE) where loops can't be joined.
// Preconditions: finite vertices, loops of three vertices or more that don't touch.
NewSurface fill_loops(const OpenLoops& input, bool bridge, const SolverOptions& options,
                      const ProgressCallback& progress);

}  // namespace fairing
