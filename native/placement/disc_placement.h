// An initial placement that is a valid map, whatever the surface's shape.
#pragma once

#include <optional>

#include "placement/placement.h"

namespace fairing {

// Puts each vertex where both patches agree in the unit disc: the problem's patch and that of the surface (`proxy`, the
// target's) are laid out there with the boundary on the circle and each inner vertex at the mean of its neighbours,
// which folds nothing (Tutte 1963). No sheet is doubled then; triangles are as irregular as in both layouts. Nothing
// where the patch is no disc, or has fixed vertices off its boundary.
std::optional<Placement> by_disc(const Problem& problem, const Patch& proxy, const TargetSurface& target);

}  // namespace fairing
