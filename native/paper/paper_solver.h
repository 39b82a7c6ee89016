// The construction of Schneider & Kobbelt 2001 (§7), step for step: hierarchy, start, factorised iteration.
#pragma once

#include "base/progress.h"
#include "fairness/row_weights.h"
#include "paper/options.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// What the construction needs besides the solver's problem, whose own weights it ignores.
struct PaperProblem {
    const Problem& problem;
    PaperOptions paper;
    RowWeights weights;  // λ; coarse levels have what the vertices they lack handed on
};

// Solves the outer equation from the boundary data; the interior given shapes λ alone.
// Deterministic. Throws SolverError when the start breaks down, Cancelled.
Solution solve_paper(const PaperProblem& paper_problem, const Progress& progress);

}  // namespace fairing
