// From a surface with tangent joins to one whose curvature continues that of its surroundings.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// `tangent`: the answer with Δ_B H = 0. It comes back bit for bit where it has the curvature already, to a hundredth;
// and, with the reason in `join`, where no curvature is known or noise speaks louder, where it is no accepted solution
// on the patch's own mesh, and where the join finds none that is accepted.
Solution joined(const Problem& problem, Solution tangent, const Progress& progress);

}  // namespace fairing
