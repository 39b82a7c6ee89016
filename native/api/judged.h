// All that a verdict reads of a new surface in its mesh, measured in one call.
#pragma once

#include "base/progress.h"
#include "geometry/hard_edges.h"
#include "shape/visible_join.h"

namespace fairing {

// Unused points may be anything. Triangles of `others` with a corner that isn't finite are left out.
struct JudgedMesh {
    Points points;
    Triangles surface;
    Triangles others;  // that are no part of it, wound either way
    Indices held;      // vertices of the surface that stay
    Indices rim;       // those of them at which the join counts
};

// The same mesh as it was, with other triangles where the surface is. `moved`: vertices whose edges are compared,
// ascending; none where the triangles are others. `marked`: edges among these that were marked as hard.
struct JudgedBefore {
    Points points;
    Triangles surface;
    Indices moved = {};
    VertexPairs marked = {};
};

// Triangles of a surface, ascending.
struct Faults {
    Indices folded;    // turned over, with a corner that moves
    Indices crossing;  // through others of the surface
};

struct Judged {
    VisibleJoin join;
    Faults now;
    std::optional<Faults> before;  // the old surface's; crossings are looked for only if `now` has some
    Indices pierced;               // triangles of the surface that pass through others, and did not before
    Indices rounded;               // moved vertices of hard edges, outside or going on there, now flatter
    Indices blunt;                 // the same at marked edges of the surface
    Indices seams;                 // see shape/kinks
};

// Vertices by the mesh's numbers. `is_clear`: no triangle of the surface is known to cross another one. Throws what
// check_mesh throws, and Cancelled.
Judged judged(const JudgedMesh& now, const std::optional<JudgedBefore>& before, bool is_clear,
              const ProgressCallback& progress);

}  // namespace fairing
