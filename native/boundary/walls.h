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

// All edges with one triangle on either side, smaller index first, ascending.
VertexPairs boundary_edges(const PatchInMesh& mesh);

struct Walls {
    VertexPairs edges;
    Points film;  // closing_surface over the vertices that don't move; empty without any wall
};

// The boundary edges at which the surroundings are walls. A film over the boundary dips below their tangents there, and
// their curvature does not explain it: on a ball, curvature times distance to the loop's middle is the sine of the dip,
// on the sides of boxes, cans and cones it is nearly nothing; of a single row up to a border nobody knows it, and the
// row of a wall goes one way all along. Or their first two rows lie on an arc that curves more than any ball that spans
// the loop, and goes on in the film: a bevel. Tangents and curvatures are those of cuts across the edges: no fits, as
// any three rows lie on a ball or a strip. Between several loops the path to the next one takes the film's place, which
// has a waist where a tube goes on, and `hard_bend` that of half of it. A boundary is parted where `hard` edges outside
// end at it, and each part decides as a whole; walls shorter than an eighth of their loop don't count. The patch counts
// in its mean alone, so that noise does not: a part is no wall where the patch's own triangles go on along the
// surroundings, as at the end of a finger; along a bevel it doesn't count at all. `still`: vertices that don't move.
Walls walls_of(const PatchInMesh& mesh, const Indices& still, const VertexPairs& hard);

}  // namespace fairing
