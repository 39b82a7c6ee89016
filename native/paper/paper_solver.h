// The construction of Schneider & Kobbelt 2001 (§7), step for step: hierarchy, start, factorised iteration.
#pragma once

#include "base/progress.h"
#include "paper/options.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Solves the outer equation from the boundary data; the interior given shapes λ alone.
// Deterministic. Throws SolverError when the start breaks down, Cancelled.
Solution solve_paper(const Problem& problem, const PaperOptions& paper, const Progress& progress);

}  // namespace fairing
