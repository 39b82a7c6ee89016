#include "paper/factorised_iteration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paper/vertex_update.h"

namespace fairing {

namespace {

constexpr double hopeless_growth = 1e6;
// Updates without a residual lower than the lowest so far by a hundredth.
constexpr int patience = 400;

class FactorisedIteration {
public:
    FactorisedIteration(const LevelProblem& level, const Points& start, const IterationLimits& limits)
        : level_(level), limits_(limits), disks_(level.patch), equation_(level.patch) {
        state_.points = start;
    }

    IterationOutcome run(const Progress& progress) {
        for (int k = 0;; ++k) {
            report(k, progress);
            const double residual = measure();
            if (k == 0) outcome_.initial_residual = residual;
            outcome_.iterations = k;
            keep_best(residual, k);
            if (residual <= limits_.epsilon) {
                outcome_.termination = Termination::converged;
                break;
            }
            if (k == limits_.max_iterations) break;
            if (!(residual < hopeless_growth * outcome_.residual) || k - improved_at_ > patience) {
                outcome_.termination = Termination::stalled;
                break;
            }
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

    double measure() {
        state_.measure(level_, disks_);
        equation_.assemble(state_.stiffness);
        return state_.residual(level_, equation_);
    }

    void keep_best(double residual, int k) {
        if (k > 0 && !(residual < outcome_.residual)) return;
        if (k == 0 || residual < 0.99 * mark_) {
            mark_ = residual;
            improved_at_ = k;
        }
        outcome_.residual = residual;
        outcome_.points = state_.points;
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
            const VertexTarget target{level_.weights.mean(i, state_.points), wanted[i], level_.paper.damping,
                                      level_.completes(i, disk.valence())};
            state_.points.col(i) = updated_position(disk, state_.points, normal, target, curvature);
            state_.normals.col(i) = normal;
        }
    }

    const LevelProblem& level_;
    const IterationLimits limits_;
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
