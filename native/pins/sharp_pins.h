// Pins at which a surface comes to a point.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Isolated pins, by their places among the fixed vertices, with a triangle whose normal is more than 60° from the
// vertex's own, the mean by area: the tip of a needle of at most 30° to its axis. `points`: 3 × local vertices.
Indices sharp_pins(const Patch& patch, const Points& points);

}  // namespace fairing
