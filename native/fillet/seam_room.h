// How wide fillets may be: the room beside their seams.
#pragma once

#include "fillet/seam_mesh.h"

namespace fairing {

struct SeamRoom {
    double usual;  // a fifth of the shortest side beside the seams: where nobody says how wide; 0 without seams
    VectorX
        widest;  // of each vertex: up to there fillets stay clear of each other and of walls; infinite off the seams
};

// By ways square to the seams' edges, from their middles straight on over the surface to the next seam, wall or border.
// A piece of a seam, from corner to corner, has one `widest` on its side; `usual` is that of the middle one of its
// ways.
SeamRoom seam_room(const SeamMesh& mesh);

}  // namespace fairing
