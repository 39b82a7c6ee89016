// Triangles that a placement turns over.
#pragma once

#include "placement/placement.h"

namespace fairing {

// Whether the normal of triangle `t` of the problem's patch points against the surface that its free corners lie on
// (the triangles of the target, so that noise of the outline's normals doesn't matter). False without a free corner:
// no placement turns such a triangle.
bool is_folded(const Problem& problem, const TargetSurface& target, const Placement& placement, int t);

// All of them, ascending.
Indices folded_triangles(const Problem& problem, const TargetSurface& target, const Placement& placement);

}  // namespace fairing
