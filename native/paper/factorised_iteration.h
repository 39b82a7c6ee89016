// The factorised iteration of one level (paper §7.1, 7.2).
#pragma once

#include "base/progress.h"
#include "paper/level_problem.h"
#include "problem/solution.h"

namespace fairing {

struct IterationLimits {
    // Stop at max |Δ_B H − f| D³ ≤ ε with inner fairness to match, or, where ε is 0, when the changes still to come are
    // estimated not to exceed the tolerance (units of D).
    double epsilon;
    double tolerance;
    int max_iterations;  // updates of the mesh
    double damping;      // s to begin with; halved where vertices alternate
};

struct IterationOutcome {
    Points points;
    Termination termination = Termination::iteration_limit;
    int iterations = 0;
    double residual = 0.0;  // of `points`
    double initial_residual = 0.0;
};

// Alternates local and global updates of the mesh until the limits are met. Where they are not, the positions come
// back that had the lowest residual (plain iteration) or that changed least (accelerated). Asks `progress` twice for
// each cycle of two updates; throws Cancelled.
IterationOutcome fair_level(const LevelProblem& level, const Points& start, const IterationLimits& limits,
                            const Progress& progress);

}  // namespace fairing
