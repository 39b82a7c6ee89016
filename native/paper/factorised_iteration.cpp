#include "paper/factorised_iteration.h"

#include "linear/anderson.h"
#include "linear/limits.h"

namespace fairing {

namespace {

constexpr std::size_t fewest_steps = 4;  // for a contraction
constexpr double fastest = 0.8;          // contraction

constexpr std::size_t window = 10;  // cycles over which contraction shows
constexpr int patience = 50;        // cycles without a hundredth less: 399 of 400 random problems converge

constexpr double smallest_damping = 0.05;  // below, the iteration is lost

// Mean edge length over that around each free vertex: the weight of its moves, so that crowded regions converge too.
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
        double moved = std::numeric_limits<double>::infinity();  // by the larger one of the two updates
        if (std::isfinite(residual)) {
            update_.global(damping_);
            progress.here().report(0.0, "iteration");
            const Points between = update_.points();
            if (std::isfinite(update_.measure(Arcs::as_before))) update_.local(damping_);
            moved = std::max(largest(update_.points(), between), largest(between, before));
        }
        switch (watch_.judge(accelerated_ ? moved / damping_ : residual)) {
            case Verdict::better:
                outcome_.points = before;
                outcome_.residual = residual;
                break;
            case Verdict::fair: break;
            case Verdict::alternating: return calm(false);
            case Verdict::lost: return calm(true);
        }
        const double step = advance(before);
        remaining_.add(std::max(moved, step));
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

    // Smaller steps, where vertices alternate between positions (§7.5), mostly next to an boundary that is much finer
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

void RemainingChange::add(double step) {
    steps_.push_back(step);
    if (steps_.size() > window) steps_.pop_front();
    if (steps_.size() == fewest_steps && first_ == 0.0) first_ = estimate();
}

double RemainingChange::estimate() const {
    if (steps_.size() < fewest_steps) return std::numeric_limits<double>::infinity();
    // Accelerated steps fall unevenly: a single small one says little.
    const double last = *std::max_element(steps_.end() - 3, steps_.end());
    const double ratio = last / std::max(steps_.front(), 1e-300);
    const auto between = static_cast<double>(steps_.size() - 3);
    const double contraction = std::max(std::pow(ratio, 1.0 / between), fastest);
    return contraction < 1.0 ? last * contraction / (1.0 - contraction) : std::numeric_limits<double>::infinity();
}

double RemainingChange::share_done(double tolerance) const {
    const double now = estimate();
    if (!(now < first_) || !(tolerance < first_)) return 0.0;
    return std::min(1.0, std::log(first_ / std::max(now, 1e-300)) / std::log(first_ / tolerance));
}

Verdict ProgressWatch::judge(double merit) {
    if (!std::isfinite(merit)) return Verdict::lost;
    ++since_mark_;
    if (merit < 0.99 * mark_) {
        mark_ = merit;
        since_mark_ = 0;
    }
    const bool better = merit < best_;
    best_ = std::min(best_, merit);
    if (since_mark_ > patience) return Verdict::alternating;
    return better ? Verdict::better : Verdict::fair;
}

void ProgressWatch::restart() {
    mark_ = std::numeric_limits<double>::infinity();
    since_mark_ = 0;
}

IterationOutcome fair_level(const LevelProblem& level, const Points& start, const IterationLimits& limits,
                            const Progress& progress) {
    return FactorisedIteration(level, start, limits).run(progress);
}

}  // namespace fairing
