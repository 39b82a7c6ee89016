// How wide fillets may be: the room beside their seams.
#pragma once

#include "fillet/seam_mesh.h"

namespace fairing {

struct SeamRoom {
    double usual;  // a fifth of the shortest side beside the seams, but for a tenth of their length; 0 without seams
    VectorX
        widest;  // of each vertex: so wide fillets from both sides nearly meet, or reach a wall; infinite without limit
};

// By paths square to the seams' edges straight on over the surface to the next seam, wall or border. Sides of a face
// that meet in a corner do not limit each other.
SeamRoom seam_room(const SeamMesh& mesh);

}  // namespace fairing
