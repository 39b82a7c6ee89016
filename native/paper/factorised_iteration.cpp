#include "paper/factorised_iteration.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "linear/anderson.h"
#include "linear/limits.h"
#include "paper/convergence.h"
#include "paper/level_update.h"

namespace fairing {

namespace {

constexpr double smallest_damping = 0.05;  // below, the iteration is lost

// Mean edge length over that around each free vertex: the weight of its moves, so that crowded regions settle too.
Eigen::RowVectorXd crowding(const Patch& patch, const Points& points) {
    Eigen::RowVectorXd inverse(patch.free_count);
    for (int i = 0; i < patch.free_count; ++i) {
        const auto neighbours = patch.ring(i).vertices;
        double sum = 0.0;
        for (int v : neighbours) sum += (points.col(v) - points.col(i)).norm();
        inverse[i] = static_cast<double>(neighbours.size()) / std::max(sum, 1e-300);
    }
    return inverse * inverse.cwiseInverse().mean();
}

// Cycles of a global and a local update, after a local one that smooths what the prolongation has left.
class FactorisedIteration {
public:
    FactorisedIteration(const LevelProblem& level, const Points& start, const IterationLimits& limits)
        : level_(level),
          start_(start),
          limits_(limits),
          accelerated_(level.paper.acceleration == Acceleration::anderson),
          weights_(crowding(level.patch, start)),
          update_(level, start),
          anderson_(history_depth),
          watch_(accelerated_),
          damping_(limits.damping) {}

    IterationOutcome run(const Progress& progress) {
        outcome_.points = start_;
        outcome_.initial_residual = outcome_.residual = update_.measure();
        if (limits_.max_iterations > 0 && std::isfinite(outcome_.residual)) update_.local(damping_);
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
        Change change;
        if (std::isfinite(residual)) {
            update_.global(damping_);
            progress.here().report(0.0, "iteration");
            const Points between = update_.points();
            if (update_.measure_again()) update_.local(damping_);
            change.largest = std::max(largest(update_.points(), between), largest(between, before));
            change.together = largest(update_.points(), before);
        }
        change.merit = accelerated_ ? change.largest / damping_ : residual;
        switch (watch_.judge(change)) {
            case Verdict::better:
                outcome_.points = before;
                outcome_.residual = residual;
                break;
            case Verdict::fair: break;
            case Verdict::alternating: return calm(false);
            case Verdict::lost: return calm(true);
        }
        const double step = advance(before);
        remaining_.add(std::max(change.largest, step));
    }

    // Largest weighted move.
    [[nodiscard]] double largest(const Points& after, const Points& before) const {
        const auto n = level_.patch.free_count;
        return ((after - before).leftCols(n).colwise().norm().array() * weights_.array()).maxCoeff();
    }

    // To where the next cycle starts; returns the largest move.
    double advance(const Points& before) {
        if (accelerated_) {
            const auto n = level_.patch.free_count;
            Points x = before.leftCols(n).array().rowwise() * weights_.array();
            const Points f = (update_.points() - before).leftCols(n).array().rowwise() * weights_.array();
            const auto flat = [](const Points& points) {
                return Eigen::Map<const VectorX>(points.data(), points.size());
            };
            const VectorX step = anderson_.step(flat(x), flat(f));
            x = Eigen::Map<const Points>(step.data(), 3, n).array().rowwise() / weights_.array();
            const double longest = x.colwise().norm().maxCoeff();
            Points after = before;
            after.leftCols(n) += longest > longest_step ? Points(x * (longest_step / longest)) : x;
            update_.move_to(after);
        }
        return largest(update_.points(), before);
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
    Eigen::RowVectorXd weights_;
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
