// The factorised iteration of one level (paper §7.1, 7.2).
#pragma once

#include <deque>

#include "base/progress.h"
#include "paper/level_update.h"
#include "problem/solution.h"

namespace fairing {

// The changes still to come, from the latest steps of a linearly convergent iteration.
class RemainingChange {
public:
    void add(double step);  // largest move of a vertex in one cycle
    // step · ρ/(1 − ρ), the step being the largest of the last three and ρ the mean contraction over the last ten, but
    // no less than 0.8; infinite while there are fewer than four.
    [[nodiscard]] double estimate() const;
    // Decades from the first estimate down to the tolerance: the part that is done.
    [[nodiscard]] double share_done(double tolerance) const;

private:
    std::deque<double> steps_;
    double first_ = 0.0;
};

enum class Verdict {
    better,       // than ever
    fair,         // go on
    alternating,  // vertices alternate between positions (§7.5), or nothing moves any more
    lost          // no longer finite
};

// Follows an iteration, cycle by cycle, by what should fall: the residual of the plain one, the changes of the
// accelerated one. Both may grow for a while.
class ProgressWatch {
public:
    Verdict judge(double merit);
    void restart();  // after a change of the damping

private:
    double best_ = std::numeric_limits<double>::infinity();
    double mark_ = std::numeric_limits<double>::infinity();
    int since_mark_ = 0;
};

struct IterationLimits {
    // Stop when the changes still to come are estimated not to exceed the tolerance (units of D).
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
