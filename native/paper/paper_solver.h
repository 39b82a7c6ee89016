// The construction of Schneider & Kobbelt 2001 (§7), step for step: hierarchy, start, factorised iteration.
#pragma once

#include "base/progress.h"
#include "paper/options.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Solves Δ_B H = 0, or H = 0 for soap films, from the boundary data; the interior given shapes λ alone.
// Deterministic. Throws SolverError when the start breaks down, Cancelled.
Solution solve_paper(const Problem& problem, const PaperOptions& paper, const Progress& progress);

}  // namespace fairing
