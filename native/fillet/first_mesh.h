// The mesh that a fillet's new one begins with: the pieces of the old one, without what booleans leave. Triangles of
// nearly no area stop all moves of a mesh that is made even, and places that no shortest path enters look as if they
// were outside.
#pragma once

#include "base/types.h"

namespace fairing {

// A cut mesh: which of its triangles are within the fillet, and edges of its seams.
struct CutPieces {
    const Points& points;
    const Triangles& triangles;
    std::vector<char> inside;
    std::vector<std::array<int, 2>> seams;
};

struct FirstMesh {
    std::vector<char> inside;  // of all triangles: those outside that one new edge would span are within, too
    Indices pieces;            // the triangles of the cut mesh that these are,
    Triangles triangles;       // with tiny edges closed
    std::vector<std::array<int, 2>> lines;  // edges of seams that the new mesh begins with
};

// The boundary's edges stay. `spacings`: of each vertex, the length of the new edges there.
FirstMesh first_mesh(CutPieces cut, const VectorX& spacings);

}  // namespace fairing
