// Quads in rows over a surface that is known.
#pragma once

#include "api/fair.h"
#include "quads/layout.h"

namespace fairing {

struct QuadMesh {
    Indices boundary;     // of the old mesh, the surface on its left, loop after loop: the pattern's first numbers
    QuadPattern pattern;  // without faces where none fits, or fixed vertices lie within
    Points vertices;      // the new ones, on curved triangles over the old ones,
    Points normals;       // of the surface there, unit,
    Indices triangle;     // the old triangle under each,
    Points weights;       // and its barycentric coordinates there
    QuadShapes shapes;
    int poles = 0;
    int least_poles = 0;  // that the boundary's corners ask for
};

// The pattern of the best shapes over the only component of a mesh, with one boundary loop or two. Throws what
// check_mesh throws, NO_FREE_VERTICES, SolverError and Cancelled.
QuadMesh quad_mesh(const MeshInput& input, const ProgressCallback& progress);

}  // namespace fairing
