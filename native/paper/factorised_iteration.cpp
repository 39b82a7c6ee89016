#include "paper/factorised_iteration.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "paper/vertex_update.h"

namespace fairing {

namespace {

// Where vertices alternate between positions (§7.5), mostly next to an outline that is much finer than the mesh inside,
// s is halved: when the residual has grown by this factor within so many updates, when it hardly falls any more, or
// when the surface leaves all bounds.
constexpr double growth_of_alternation = 2.0;
constexpr std::size_t window = 20;
constexpr double widest_surface = 4.0;  // units of D
constexpr double smallest_damping = 0.05;
constexpr double hardly_falling = 0.97;  // lowest residual of a spell of updates over that of the spell before
constexpr int spell = 30;
// Updates without a hundredth less of the residual.
constexpr int patience = 300;

class FactorisedIteration {
public:
    FactorisedIteration(const LevelProblem& level, const Points& start, const IterationLimits& limits)
        : level_(level),
          start_(start),
          limits_(limits),
          damping_(limits.damping),
          disks_(level.patch),
          equation_(level.patch) {
        state_.points = start;
    }

    IterationOutcome run(const Progress& progress) {
        for (int k = 0;; ++k) {
            report(k, progress);
            const double residual = measure();
            outcome_.iterations = k;
            keep_best(residual, k);
            if (residual <= limits_.epsilon && state_.unfairness(level_, disks_) <= limits_.unfairness) {
                outcome_.termination = Termination::converged;
                break;
            }
            if (k == limits_.max_iterations) break;
            if (k - improved_at_ > patience || damping_ < smallest_damping) {
                outcome_.termination = Termination::stalled;
                break;
            }
            calm_alternation(residual, k);
            update_vertices(wanted_curvature(k));
        }
        return std::move(outcome_);
    }

private:
    void report(int k, const Progress& progress) const {
        const double decades = std::log10(std::max(outcome_.initial_residual / limits_.epsilon, 10.0));
        const double gained = k > 0 ? std::log10(std::max(outcome_.initial_residual / outcome_.residual, 1.0)) : 0.0;
        progress.report(std::max(gained / decades, static_cast<double>(k) / limits_.max_iterations), "iteration");
    }

    // Infinite where the surface has left all bounds: there the residual, a third power of 1/length, means nothing.
    double measure() {
        const double extent = state_.points.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
        if (!(extent < widest_surface)) return std::numeric_limits<double>::infinity();
        state_.measure(level_, disks_);
        equation_.assemble(state_.stiffness);
        return state_.residual(level_, equation_);
    }

    void keep_best(double residual, int k) {
        if (residual < 0.99 * mark_) {
            mark_ = residual;
            improved_at_ = k;
        }
        if (k == 0) {
            outcome_.initial_residual = residual;
        } else if (!(residual < outcome_.residual)) {
            return;
        }
        outcome_.residual = residual;
        outcome_.points = state_.points;
    }

    [[nodiscard]] bool growing() const {
        return recent_.size() > window && recent_.back() > growth_of_alternation * recent_[recent_.size() - 1 - window];
    }

    [[nodiscard]] bool resting() const {
        if (recent_.size() < 2 * spell || damping_ < limits_.damping) return false;
        const auto middle = recent_.end() - spell;
        const double before = *std::min_element(middle - spell, middle);
        return *std::min_element(middle, recent_.end()) > hardly_falling * before;
    }

    void calm_alternation(double residual, int k) {
        recent_.push_back(residual);
        if (recent_.size() > 2 * spell) recent_.pop_front();
        const bool escaped = !std::isfinite(residual);
        if (!escaped && !growing() && !resting()) return;
        damping_ *= 0.5;
        recent_.clear();
        mark_ = residual;
        improved_at_ = k;
        if (!escaped) return;
        // Not from the lowest residual so far: it falls with the third power of the size of a surface that inflates.
        state_.points = start_;
        outcome_.points = start_;
        outcome_.residual = outcome_.initial_residual;
        measure();
    }

    // H̃: step I, local and global in turn, from the present curvature.
    VectorX wanted_curvature(int k) {
        if (level_.solver.equation == Equation::minimal) return VectorX::Zero(level_.patch.vertex_count());
        VectorX H = state_.H;
        const VectorX rhs = state_.right_hand_side(level_);
        if (k % 2 == 0) {
            equation_.sweep(rhs, level_.paper.h_sweeps, H);
        } else {
            equation_.conjugate_gradients(rhs, level_.paper.cg_steps, H);
        }
        return H;
    }

    // Step II: neighbours that have moved count with their new position.
    void update_vertices(const VectorX& wanted) {
        DiskCurvature curvature(state_.points, state_.normals);
        for (int i = 0; i < level_.patch.free_count; ++i) {
            const Disk disk = disks_[i];
            const Vector3 normal = disk_normal(disk, state_.points);
            const VertexTarget target{level_.weights.mean(i, state_.points), wanted[i], damping_,
                                      level_.completes(i, disk.valence())};
            state_.points.col(i) = updated_position(disk, state_.points, normal, target, curvature);
            state_.normals.col(i) = normal;
        }
    }

    const LevelProblem& level_;
    const Points& start_;
    const IterationLimits limits_;
    double damping_;
    std::deque<double> recent_;  // residuals since the damping was changed
    DiskTable disks_;
    CurvatureEquation equation_;
    LevelState state_;
    IterationOutcome outcome_;
    double mark_ = std::numeric_limits<double>::infinity();
    int improved_at_ = 0;
};

}  // namespace

IterationOutcome fair_level(const LevelProblem& level, const Points& start, const IterationLimits& limits,
                            const Progress& progress) {
    return FactorisedIteration(level, start, limits).run(progress);
}

}  // namespace fairing
