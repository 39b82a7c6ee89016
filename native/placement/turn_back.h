// Turns the last folded triangles back by trying other places for their corners.
#pragma once

#include "placement/placement.h"

namespace fairing {

// For a placement with at most `few_folds` triangles that are turned over against the surface or against their
// neighbours (folded_triangles). Their free corners, then those beside them, go to the nearest of some places around
// where fewest triangles are turned over; they stay where that gains nothing. Returns whether any has moved.
bool turn_back(const Problem& problem, const TargetSurface& target, Placement& placement);

}  // namespace fairing
