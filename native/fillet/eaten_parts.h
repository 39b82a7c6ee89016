// Parts between seams that a fillet takes whole.
#pragma once

#include "fillet/cut_mesh.h"

namespace fairing {

struct EatenPart {
    Indices vertices;  // ascending
    double widest;     // the largest distance from its seams, to a hundredth: narrower fillets leave something of it
    bool held;         // whether it lies between two parts of which something is left, and no other than such parts:
                       // fillets from both sides meet there
};

// Parts without a wall, a border or a piece outside. Those that reach no further from their seams than `thin` are less
// than the new mesh shows, and are left out.
std::vector<EatenPart> eaten_parts(const SeamMesh& mesh, const SeamDistance& distance, const SplitMesh& cut,
                                   double thin);

}  // namespace fairing
