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

// What a cycle of a global and a local update did.
struct Change {
    double largest = std::numeric_limits<double>::infinity();   // move of a vertex in one of the two updates
    double together = std::numeric_limits<double>::infinity();  // and in both together
    double merit = std::numeric_limits<double>::infinity();     // what should fall
};

enum class Verdict {
    better,       // than ever
    fair,         // go on
    alternating,  // vertices alternate between positions (§7.5), or nothing moves any more
    lost          // no longer finite
};

// Follows an iteration, cycle by cycle. The merit of the plain one is its residual, which must not grow or rest for
// long. That of the accelerated one is its changes. They may grow for a while, since the history damps modes that the
// plain one doesn't. It may reach positions at which the two updates of a cycle undo each other. They are no solution.
class ProgressWatch {
public:
    explicit ProgressWatch(bool accelerated) : accelerated_(accelerated) {}
    Verdict judge(const Change& change);
    void restart();  // after a change of the damping

private:
    [[nodiscard]] bool undoing(const Change& change);
    [[nodiscard]] bool growing() const;
    [[nodiscard]] bool resting() const;
    bool accelerated_;
    bool restarted_ = false;
    std::deque<double> recent_;
    double best_ = std::numeric_limits<double>::infinity();
    double mark_ = std::numeric_limits<double>::infinity();
    int since_mark_ = 0;
    int undone_ = 0;  // cycles in a row
};

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
