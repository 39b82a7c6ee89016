// Pins at which a surface forms a spike.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Isolated pins, by their places among the fixed vertices, around which the triangles' normals have a mean cosine below
// 1/2 to their mean, both by area: tips of spikes whose sides lean by at most 30° to their axis. `points`: 3 × local
// vertices.
Indices sharp_pins(const Patch& patch, const Points& points);

}  // namespace fairing
