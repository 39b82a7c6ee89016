// How visible the join of a patch with its surroundings is: dihedral angles along the boundary against those nearby.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// A mesh in two parts that meet in a boundary.
struct JoinedMesh {
    Points vertices;
    Triangles inside;
    Triangles outside;
};

// How much a join shows, and where the eye finds a kink.
struct VisibleJoin {
    VectorX degrees;     // at each vertex of the boundary
    double limit = 0.0;  // from which a kink stands out among triangles that bend as those outside do (shape/limits)
    Indices seen;        // places in the boundary where one does, ascending
};

// Degrees: by how much the signed dihedral angles of the boundary edges at a vertex exceed what is usual across their
// direction within three rings inside and outside. The mean over these edges, weighted by length; 0 where no
// boundary edge ends. Triangles that name a vertex twice are left out. `boundary`: each vertex once.
VisibleJoin visible_join(const JoinedMesh& mesh, const Indices& boundary);

// The degrees from the patch's side alone, at its fixed vertices (local order): the surroundings are taken for the
// patch's mirror image across the prescribed tangent planes.
VectorX one_sided_join(const Patch& patch, const Points& points, const Points& prescribed);

}  // namespace fairing
