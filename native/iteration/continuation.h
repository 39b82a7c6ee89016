// From the globalised surface to the solution of any outer equation.
#pragma once

#include "base/progress.h"
#include "iteration/accelerated_iteration.h"
#include "operators/normal_operator.h"
#include "problem/solution.h"

namespace fairing {

// The least share of the load that is tried where a larger one is too much.
inline constexpr double smallest_increment = 1.0 / 32.0;

// The accurate iteration; for a constant load after the harmonic solution, and in steps of the load where a single
// one is too much. What comes back belongs to the whole load or says that it did not converge.
Solution solve_equation(const Problem& problem, Workspace& work, const Points& start, const Progress& progress);

}  // namespace fairing
