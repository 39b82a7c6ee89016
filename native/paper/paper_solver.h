// The construction of Schneider & Kobbelt 2001 (§7), step for step: hierarchy, start, factorised iteration.
#pragma once

#include "base/progress.h"
#include "paper/options.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

struct PaperProblem {
    const Problem& problem;
    PaperOptions paper;
};

// Solves the outer equation from the boundary data; the interior given shapes λ alone.
// Deterministic. Throws SolverError when the start breaks down, Cancelled.
Solution solve_paper(const PaperProblem& paper_problem, const Progress& progress);

}  // namespace fairing
