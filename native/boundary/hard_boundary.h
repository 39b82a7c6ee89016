// On which side of a boundary its surface goes on, edge by edge.
#pragma once

#include "geometry/hard_edges.h"

namespace fairing {

// A patch and its surroundings: two lists of triangles of the same vertices, without any that name one twice.
struct PatchInMesh {
    const Points& points;
    const Triangles& inside;  // near the boundary
    const Triangles& outside;
    const Triangles& whole;  // patch
};

// All edges with one triangle on either side, smaller index first, ascending.
VertexPairs outline_edges(const PatchInMesh& mesh);

// Those of them at which the surface takes the slope of the patch's own triangles: hard edges that a surface over the
// boundary (closing_surface over the vertices that are not `held`) leaves nearer to these than to those outside, by
// half a hard edge's bend at least. The top of a box has such an outline; a boss on a plate has not, nor a pocket, nor
// half a ball that is turned inside out. Edges that hang together decide together, and only where they close a loop or
// go on outside: otherwise the patch has made them.
VertexPairs inward_edges(const PatchInMesh& mesh, const VertexPairs& creases, const std::vector<char>& held);

}  // namespace fairing
