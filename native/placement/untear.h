// What is turned over or passes through others beside a boundary that lies off the surface.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// `points` (3 × local vertices) with fewer torn triangles (placement/tears), or as they are: what lies around these is
// filled anew, then their free corners are tried elsewhere, on the surface and off it. The fixed vertices stay, and
// what lies farther than six rings from torn triangles.
Points untorn(const Patch& patch, Points points);

}  // namespace fairing
