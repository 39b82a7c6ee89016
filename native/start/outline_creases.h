// Where an outline crosses a crease of the surface around it.
#pragma once

#include "base/types.h"

namespace fairing {

// Places in a closed loop (columns of `normals`, unit) from whose one neighbour to the other the normals turn by more
// than 60°, and by more than twice as much as in the two edges on either side: trailing and leading edges of wings, but
// not coarse rounds or noise. The sharpest first. The normal at such a place itself says nothing.
Indices outline_creases(const Indices& loop, const Points& normals);

}  // namespace fairing
