// Triangles that a placement turns over.
#pragma once

#include "placement/placement.h"

namespace fairing {

// Up to so many folds are always worked on. More of them that do not become fewer are a whole sheet that is turned
// over.
inline constexpr std::size_t few_folds = 20;

// Whether the normal of triangle `t` of the problem's patch points against the surface that its free corners lie on
// (the triangles of the target, so that noise of the boundary's normals doesn't matter). False without a free corner:
// no placement turns such a triangle.
bool is_folded(const Problem& problem, const TargetSurface& target, const Placement& placement, int t);

// All of them, as a mask.
std::vector<char> folded_mask(const Problem& problem, const TargetSurface& target, const Placement& placement);

// All of them, and those that are turned over against their neighbours in the placed mesh itself; ascending.
Indices folded_triangles(const Problem& problem, const TargetSurface& target, const Placement& placement);

// The same without triangles at the boundary that only their neighbours speak against: where the boundary itself turns
// sharply, no placement gives them other neighbours.
Indices folds_of_placement(const Problem& problem, const TargetSurface& target, const Placement& placement);

}  // namespace fairing
