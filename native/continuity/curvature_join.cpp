#include "continuity/curvature_join.h"

#include <cmath>

#include "continuity/join_operator.h"
#include "linear/anderson.h"
#include "linear/limits.h"
#include "linear/shrinking_steps.h"
#include "problem/surface_state.h"
#include "tangential/tangential_step.h"

namespace fairing {

namespace {

class CurvatureJoin {
public:
    CurvatureJoin(const Problem& problem, const KnownCurvature& known, const Points& start, int vertices_per_wave,
                  const Progress& progress)
        : problem_(problem),
          patch_(problem.patch),
          known_(known),
          progress_(progress),
          modes_(known.curves, problem.fixed_points, vertices_per_wave),
          operator_(problem.patch, problem.fixed_points, modes_, start.leftCols(problem.patch.free_count)),
          tangential_(make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())),
          anderson_(history_depth),
          coefficients_(VectorX::Zero(modes_.count())) {
        state_.points = start;
    }

    Solution run() {
        const int most = std::min(nearby.steps, problem_.options.max_iterations);
        solution_.termination = Termination::iteration_limit;
        for (int k = 0; k < most; ++k) {
            progress_.report(static_cast<double>(k) / most, "curvature");
            if (!measure()) return failed();
            const Points d = step();
            const double largest = largest_length(d);
            solution_.iterations = k + 1;
            solution_.last_step = largest;
            if (k == 0) solution_.first_step = largest;
            if (largest <= problem_.options.tolerance) {
                solution_.termination = Termination::converged;
                break;
            }
            if (!std::isfinite(largest) || steps_.in_vain(largest) > nearby.in_vain) return failed();
            anderson_.move(state_.points, d, longest_step);
        }
        solution_.points = state_.points;
        solution_.mean_curvature = state_.curvature.mean;
        return std::move(solution_);
    }

private:
    Solution failed() {
        solution_.termination = Termination::stalled;
        solution_.points = state_.points;
        return std::move(solution_);
    }

    // False where the surface has degenerated.
    bool measure() {
        state_.measure_faces(patch_);
        state_.measure_curvature(problem_);
        if (!state_.curvature.mean.allFinite()) return false;
        if (!operator_.update(state_.stiffness, progress_.here())) return false;
        const VectorX mass = state_.stiffness.mass.head(patch_.free_count);
        residual_ = harmonic_residual(problem_, state_) - mass.cwiseProduct(operator_.harmonic(coefficients_));
        solution_.residual = residual_.cwiseAbs().cwiseQuotient(2.0 * mass).maxCoeff();
        return std::isfinite(solution_.residual);
    }

    Points step() {
        const VectorX H = state_.curvature.mean.tail(problem_.fixed_points.cols());
        const JoinOperator::Step step = operator_.solve(residual_, known_.missing(H));
        coefficients_ += step.coefficients;
        return state_.moves(tangential_->displacement(state_.points, state_.normals), step.heights);
    }

    const Problem& problem_;
    const Patch& patch_;
    const KnownCurvature& known_;
    const Progress& progress_;
    OutlineModes modes_;
    JoinOperator operator_;
    std::unique_ptr<TangentialStep> tangential_;
    Anderson anderson_;
    VectorX coefficients_;  // of the multipliers
    SurfaceState state_;
    VectorX residual_;
    ShrinkingSteps steps_;
    Solution solution_;
};

}  // namespace

Solution join_curvatures(const Problem& problem, const KnownCurvature& known, const Points& start,
                         int vertices_per_wave, const Progress& progress) {
    return CurvatureJoin(problem, known, start, vertices_per_wave, progress).run();
}

}  // namespace fairing
