// Turns folded triangles of a placement back by moving single vertices.
#pragma once

#include "placement/placement.h"

namespace fairing {

// Each vertex of a folded triangle goes where the least distance from it to the lines of its ring's edges, positive on
// the inner side, is greatest (the optimisation of Freitag & Plassmann, "Local optimization-based simplicial mesh
// untangling and improvement", 2000, solved exactly in the tangent plane), if no more triangles are folded then. Sweeps
// until nothing is folded or nothing improves. Gives the folded triangles that are left.
Indices untangle(const Problem& problem, const TargetSurface& target, Placement& placement);

}  // namespace fairing
