// On which side of its loop a surface lies: by the loop's direction and the normals there, the surface on its left.
#pragma once

#include "base/errors.h"
#include "fill/hole_shape.h"

namespace fairing {

struct BoundaryLoop {
    Indices vertices;
    LoopShape shape;
    VectorX curvatures = {};  // prescribed H, NaN where it is not known; empty: none is
    bool is_bare = false;     // no triangle holds it
    bool is_pinched = false;  // the border of the mesh passes one of its vertices several times

    void turn();
    // Rotates all rows but angles, so that what is made over it depends neither on where its caller began nor on how
    // the mesh is numbered: by the distances from its middle and the lengths of edges. Among places that are alike so,
    // the lowest number begins.
    void begin_anew();
};

// Turns loops that no triangle holds where the surface would lead away from the others that are to be joined, or out of
// a lone loop. Throws LOOPS_NOT_JOINED where a tube would be seen from outside at one end and from inside at the other,
// and for two holes in walls that face one way.
void settle_sides(std::vector<BoundaryLoop>& loops, bool joined);

// Why no triangulation joins the loops: which of them leads away, and what to do.
Diagnostic not_joined(const std::vector<BoundaryLoop>& loops);

// "vertex 3", "vertices 1, 2, 3, 4, 5 and 7 more"
std::string listed(const Indices& vertices);

}  // namespace fairing
