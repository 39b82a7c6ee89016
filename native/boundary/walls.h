// Where the surroundings of a patch end in an edge, so that its surface does not go on with their slope.
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

// Edges between a triangle inside and one outside, smaller index first, ascending.
VertexPairs boundary_edges(const PatchInMesh& mesh);

struct Walls {
    VertexPairs edges;
    Points film;  // closing_surface over the vertices that don't move; empty without any wall
};

// The boundary edges at which the surroundings are walls. There a film over the boundary and the patch's own triangles
// both bend off the tangents outside, and the curvature outside explains less than a quarter of the film's bend (all of
// it on a ball, nothing on a box). A single row shows no curvature: it is a wall where it leads off in one direction
// all along. Bevels are walls, too: the first two rows lie on an arc that curves more than any ball that spans the
// loop, and the film continues it. Tangents and curvatures come from cuts across the edges, not from fits, which make a
// ball or a strip of any three rows. Between several loops the direction to the next loop replaces the film, which has
// a waist, and the limit is `hard_bend` instead of half of it. A boundary is parted where `hard` edges outside end at
// it, and each part decides as a whole; walls shorter than an eighth of their loop don't count. The patch's triangles
// count by their mean, against noise: where they continue the surroundings, as at the end of a finger, there is no
// wall. For bevels they do not count. `still`: vertices that don't move.
Walls walls_of(const PatchInMesh& mesh, const Indices& still, const VertexPairs& hard);

}  // namespace fairing
