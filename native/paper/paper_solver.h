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
    InnerFairness inner_fairness;  // on the coarse levels; custom weights have no meaning there and count as uniform
    Points reference;              // M0: 3 × local vertices
    RowWeights weights;            // λ on the connectivity given
};

// Solves the outer equation from the boundary data; the interior given shapes the hierarchy and λ alone.
// Deterministic. Throws SolverError when the start breaks down, Cancelled.
Solution solve_paper(const PaperProblem& paper_problem, const Progress& progress);

}  // namespace fairing
