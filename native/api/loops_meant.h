// The loops that a call means, made into holes: in the right direction, and parted where they touch.
#pragma once

#include "api/holes.h"

namespace fairing {

// All loops along the border that are not too long. Throws NO_BOUNDARY where there are none.
Holes found_loops(const HoledMesh& mesh, const NamedLoops& named);

// The loops that the caller names. Throws NOT_A_LOOP where two share an edge, and with `bridge` where one is no loop.
Holes named_loops(const HoledMesh& mesh, const NamedLoops& named, bool bridge, bool are_parted = true);

}  // namespace fairing
