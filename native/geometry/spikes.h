// Where a surface comes to a point.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Whether the surface turns as much within `radius` of some free vertex as around the tip of a cone whose sides lean by
// 45° to its axis: angle defects there sum to 2π (1 − sin 45°) or more. Around a hair they sum to 2π, around an edge to
// nothing, on a sphere of radius R to π (radius / R)². `points`: 3 × local vertices.
bool has_spike(const Patch& patch, const Points& points, double radius);

}  // namespace fairing
