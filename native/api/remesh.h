// New meshes for existing surfaces.
#pragma once

#include "api/fair.h"
#include "fill/edge_lengths.h"
#include "geometry/hard_edges.h"
#include "quads/layout.h"

namespace fairing {

struct NewMesh {
    Points vertices;      // new ones
    Points normals;       // of the surface there, unit
    Triangles triangles;  // numbers below the count of old vertices are old vertices
    Indices triangle;     // of the old mesh, for each new vertex,
    Points weights;       // and its barycentric coordinates there
    Indices old;          // the old vertex that it is, one at a kept edge, or `none`
};

// A new mesh for the surface of the old one, whose fixed and border vertices stay, and the edges `kept` with the
// vertices there. Vertices lie on curved triangles (geometry/target_surface) over the old ones. `wanted.least_count`
// holds for each component. Components without free vertices stay as they are. Throws what check_mesh throws, and
// NO_FREE_VERTICES.
NewMesh remesh(const MeshInput& input, const VertexPairs& kept, const WantedLengths& wanted, int threads,
               const ProgressCallback& progress);

// About how many vertices that mesh would have.
double expected_remesh_count(const MeshInput& input, const WantedLengths& wanted);

// Closed loops of vertices, the new surface on their left, with a unit normal for each vertex.
struct OpenLoops {
    Points vertices;
    std::vector<Indices> loops;
    std::vector<Points> normals;  // 3 × size of each loop
    VertexPairs taken = {};       // that are joined outside: no edge of the surface joins them
};

// A triangle mesh whose first vertices are the caller's, all of them; then come new ones.
struct NewSurface {
    Points vertices;  // the new ones
    Triangles triangles;
    bool converged = true;                         // whether each is the equation's surface,
    Provenance provenance = Provenance::equation;  // where each comes from; `equation` where they differ
};

// One surface over all loops, or one over each; without options flat ones, `converged` unless a ball is the better
// start. The mesh is coarse (some 300 new vertices each), an initial surface for `remesh` and `fair`. Throws
// SolverError, Cancelled; MeshError (NONMANIFOLD_EDGE) where loops can't be joined. Preconditions: finite vertices,
// loops of three vertices or more that don't touch.
NewSurface fill_loops(const OpenLoops& input, bool bridge, const std::optional<SolverOptions>& options,
                      const ProgressCallback& progress);

// Quads in rows over a surface that is known.
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
