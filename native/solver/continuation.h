// From the globalised surface to the solution of any outer equation.
#pragma once

#include "solver/accelerated_iteration.h"

namespace fairing {

// The accurate iteration; for a constant load after the harmonic solution, and in steps of the load where a single
// one is too much. What comes back belongs to the whole load or says that it did not converge.
Solution solve_equation(const Problem& problem, Workspace& work, const Points& start, const Progress& progress);

}  // namespace fairing
