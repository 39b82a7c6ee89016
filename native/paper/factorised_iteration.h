// The factorised iteration of one level (paper §7.1, 7.2).
#pragma once

#include "base/progress.h"
#include "paper/level.h"

namespace fairing {

struct IterationLimits {
    double epsilon;
    double unfairness;  // of §7.3, see LevelState
    int max_iterations;
    double damping;  // s to begin with; halved where vertices alternate
};

struct IterationOutcome {
    Points points;
    Termination termination = Termination::iteration_limit;
    int iterations = 0;
    double residual = 0.0;
    double initial_residual = 0.0;
};

// Alternates updates of the mesh with local and global H-updates until max |Δ_B H − f| ≤ ε and
// inner fairness holds. The positions with the
// lowest residual come back. Asks `progress` once for each update; throws
// Cancelled.
IterationOutcome fair_level(const LevelProblem& level, const Points& start, const IterationLimits& limits,
                            const Progress& progress);

}  // namespace fairing
