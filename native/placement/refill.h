// Part of a surface filled again from what lies around it.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// The free vertices within `rings` edges of some triangles moved to where Σ |d x_v − Σ x_w|² over all vertices v, with
// their d neighbours w, is least; the others stay. `points`: 3 × local vertices.
Points refilled(const Patch& patch, const Points& points, const Indices& triangles, int rings);

}  // namespace fairing
