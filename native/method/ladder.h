// method="global": directly on the user's mesh where it carries the equation, on a proxy where it doesn't.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Solves the outer equation from the boundary data alone; the caller's interior is not looked at. Deterministic.
// Where no way is accepted (method/accept), the best that was found comes back with its flaw.
// Throws SolverError when a factorisation breaks down at the start, Cancelled.
Solution solve_global(const Problem& problem, const Progress& progress);

}  // namespace fairing
