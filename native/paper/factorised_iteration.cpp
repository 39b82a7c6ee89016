#include "paper/factorised_iteration.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "linear/anderson.h"
#include "paper/convergence.h"
#include "paper/level_update.h"

namespace fairing {

namespace {

constexpr int history_depth = 20;
constexpr double largest_step = 0.1;  // of the acceleration, units of D
constexpr double smallest_damping = 0.05;

double largest_length(const Points& moves) { return std::sqrt(moves.colwise().squaredNorm().maxCoeff()); }

// Cycles of a global and a local update, after a local one that smooths what the prolongation has left.
class FactorisedIteration {
public:
    FactorisedIteration(const LevelProblem& level, const Points& start, const IterationLimits& limits)
        : level_(level),
          start_(start),
          limits_(limits),
          accelerated_(level.paper.acceleration == Acceleration::anderson),
          update_(level, start),
          anderson_(3L * level.patch.free_count, history_depth),
          watch_(accelerated_),
          damping_(limits.damping) {}

    IterationOutcome run(const Progress& progress) {
        outcome_.points = start_;
        outcome_.initial_residual = outcome_.residual = update_.measure();
        if (limits_.max_iterations > 0) update_.local(damping_);
        for (int updates = 1; updates <= limits_.max_iterations; updates += 2) {
            report(updates, progress);
            outcome_.iterations = updates;
            const double residual = update_.measure();
            if (finished(residual)) return converged(residual);
            if (updates == limits_.max_iterations) break;
            cycle(residual, progress);
            if (damping_ < smallest_damping) {
                outcome_.termination = Termination::stalled;
                break;
            }
        }
        return std::move(outcome_);
    }

private:
    void report(int updates, const Progress& progress) const {
        progress.report(std::max(remaining_.share_done(limits_.tolerance),
                                 static_cast<double>(updates) / (limits_.max_iterations + 1)),
                        "iteration");
    }

    [[nodiscard]] bool finished(double residual) const {
        if (limits_.epsilon > 0.0) return residual <= limits_.epsilon && update_.unfairness() <= 0.04 * limits_.epsilon;
        return std::isfinite(residual) && remaining_.estimate() <= limits_.tolerance;
    }

    IterationOutcome converged(double residual) {
        outcome_.points = update_.points();
        outcome_.residual = residual;
        outcome_.termination = Termination::converged;
        return std::move(outcome_);
    }

    // One cycle; the residual is that of its first positions.
    void cycle(double residual, const Progress& progress) {
        const Points before = update_.points();
        double change = std::numeric_limits<double>::infinity();
        if (std::isfinite(residual)) {
            update_.global(damping_);
            progress.here().report(0.0, "iteration");
            if (update_.measure_again()) update_.local(damping_);
            change = largest_length(update_.points() - before);
        }
        const double merit = accelerated_ ? change / damping_ : residual;
        switch (watch_.judge(merit)) {
            case Verdict::better:
                outcome_.points = before;
                outcome_.residual = residual;
                break;
            case Verdict::fair: break;
            case Verdict::alternating: return calm(false);
            case Verdict::lost: return calm(true);
        }
        advance(before, change);
    }

    void advance(const Points& before, double change) {
        Points step = update_.points() - before;
        if (accelerated_) {
            const auto n = 3L * level_.patch.free_count;
            Eigen::Map<VectorX> free(step.data(), n);
            free = anderson_.step(Eigen::Map<const VectorX>(before.data(), n), VectorX(free));
            const double largest = largest_length(step);
            if (largest > largest_step) step *= largest_step / largest;
            update_.move_to(before + step);
        }
        remaining_.add(std::max(change, largest_length(step)));
    }

    // Smaller steps, where vertices alternate between positions (§7.5), mostly next to an outline that is much finer
    // than the mesh inside. A surface that is lost begins again.
    void calm(bool lost) {
        damping_ *= 0.5;
        anderson_.reset();
        remaining_ = RemainingChange();
        watch_.restart();
        if (!lost) return;
        // Not from the lowest residual so far: it falls with the third power of the size of a surface that inflates.
        update_.move_to(start_);
        outcome_.points = start_;
        outcome_.residual = outcome_.initial_residual;
    }

    const LevelProblem& level_;
    const Points& start_;
    const IterationLimits limits_;
    bool accelerated_;
    LevelUpdate update_;
    Anderson anderson_;
    ProgressWatch watch_;
    RemainingChange remaining_;
    double damping_;
    IterationOutcome outcome_;
};

}  // namespace

IterationOutcome fair_level(const LevelProblem& level, const Points& start, const IterationLimits& limits,
                            const Progress& progress) {
    return FactorisedIteration(level, start, limits).run(progress);
}

}  // namespace fairing
