// Hard edges that a surface has rounded off.
#pragma once

#include "geometry/hard_edges.h"

namespace fairing {

// A surface before and after, and the vertices that may have moved; ascending.
struct MovedMesh {
    Points before;
    Points after;
    Triangles triangles;
    Indices moved;
};

// Moved vertices, ascending, at hard edges (geometry/hard_edges) that became flatter by `flatter` degrees and more
// (shape/limits). These run on: `runs_on` edges of their chain lie among triangles that stay. The triangles of either
// bend at no other edge by more than `most_beside` of it, in the median.
Indices rounded_edges(const MovedMesh& change);

// The same at marked edges, wherever they end. Nothing where more than `most_marked` of all edges are: importers mark
// nearly all of them, which sets none apart.
Indices rounded_marks(const MovedMesh& change, const VertexPairs& marked);

}  // namespace fairing
