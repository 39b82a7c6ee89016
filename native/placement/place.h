// The user's vertices on the surface of a proxy, by their inner fairness and without folds.
#pragma once

#include "placement/placement.h"
#include "proxy/proxy_solver.h"
#include "solver/tangential_step.h"

namespace fairing {

struct Placed {
    Placement placement;
    Indices folded;  // triangles of the problem's patch that no way of placing turned back
};

// Tries several placements and takes the one with the fewest folds, then with the least merit (tangential_step.h). They
// begin from `guess`, a surface of the problem's own patch that has the right sheets, and from the history of the
// proxy mesh. Where the springs' minimum is folded, folds are turned back vertex by vertex, and the springs relax only
// as far as nothing folds.
Placed place(const Problem& problem, const TangentialStep& tangential, const SolvedProxy& proxy,
             const TargetSurface& target, const std::optional<Points>& guess, const Progress& progress);

}  // namespace fairing
