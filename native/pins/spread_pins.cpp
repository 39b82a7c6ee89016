#include "pins/spread_pins.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <Eigen/LU>

#include "linear/anderson.h"
#include "linear/limits.h"
#include "linear/shrinking_steps.h"
#include "operators/normal_operator.h"
#include "pins/bells.h"
#include "pins/released.h"
#include "problem/surface_state.h"
#include "tangential/tangential_step.h"

namespace fairing {

namespace {

constexpr int first_surfaces = 4;     // on which bells are measured; then they stay
constexpr double least_pivot = 1e-8;  // of the largest: pins that act alike

class SpreadPins {
public:
    SpreadPins(const Problem& problem, double radius, const Points& start, const Progress& progress)
        : given_(problem),
          pins_(isolated_pins(problem.patch)),
          count_(static_cast<int>(pins_.size())),
          released_(released(problem.patch, pins_)),
          problem_(on_released(problem, released_)),
          radius_(radius),
          progress_(progress),
          normal_(
              make_normal_operator(problem_, start(Eigen::all, released_.from).leftCols(released_.patch.free_count))),
          tangential_(make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())),
          anderson_(history_depth),
          forces_(VectorX::Zero(count_)) {
        state_.points = start(Eigen::all, released_.from);
        targets_ = problem.fixed_points(Eigen::all, pins_);
    }

    Solution run() {
        const int most = std::min(brisk.steps, given_.options.max_iterations);
        solution_.termination = Termination::iteration_limit;
        for (int k = 0; k < most; ++k) {
            progress_.report(static_cast<double>(k) / most, "pins");
            if (!measure(k)) return failed();
            const auto d = step();
            if (!d) return failed();
            const double largest = largest_length(*d);
            solution_.iterations = k + 1;
            if (k == 0) solution_.first_step = largest;
            contraction_ = k == 0 ? 0.0 : largest / solution_.last_step;
            solution_.last_step = largest;
            if (largest <= given_.options.tolerance) {
                solution_.termination = Termination::converged;
                break;
            }
            if (!std::isfinite(largest) || steps_.in_vain(largest) > brisk.in_vain) return failed();
            anderson_.move(state_.points, *d, longest_step);
        }
        return finished();
    }

private:
    // How far the pins have to go, 3 × pins.
    [[nodiscard]] Points to_go() const { return targets_ - state_.points.middleCols(given_.patch.free_count, count_); }

    Solution finished() {
        state_.points.middleCols(given_.patch.free_count, count_) = targets_;
        solution_.points = state_.points(Eigen::all, released_.to);
        solution_.mean_curvature = state_.curvature.mean(released_.to);
        return std::move(solution_);
    }

    Solution failed() {
        solution_.termination = Termination::stalled;
        return finished();
    }

    // False where the surface has degenerated.
    bool measure(int k) {
        state_.measure_faces(problem_.patch);
        state_.measure_curvature(problem_);
        if (!state_.curvature.mean.allFinite()) return false;
        const bool refresh = k == 0 || contraction_ > slow_contraction;
        return !refresh || normal_->update(state_.stiffness, progress_.here());
    }

    // Free count × pins. The bells of the first few surfaces do for all that follow, which are close.
    const Eigen::MatrixXd& weighted_bells() {
        if (bells_of_ >= first_surfaces) return bells_;
        ++bells_of_;
        Indices centres(count_);
        std::iota(centres.begin(), centres.end(), given_.patch.free_count);
        bells_ = state_.stiffness.mass.head(problem_.patch.free_count).asDiagonal() *
                 bells(problem_.patch, state_.points, state_.stiffness, centres, radius_, progress_.here())
                     .topRows(problem_.patch.free_count);
        return bells_;
    }

    // Heights along the normals that solve the equation to first order and bring the pins to their places; nothing
    // where pins act alike.
    std::optional<VectorX> heights() {
        const Eigen::MatrixXd& acting = weighted_bells();
        Eigen::MatrixXd rhs(problem_.patch.free_count, 1 + count_);
        rhs << outer_residual(problem_, state_) - acting * forces_, acting;
        solution_.residual = largest_residual(problem_, state_, rhs.col(0));
        const Eigen::MatrixXd u = normal_->solve(rhs);
        const Eigen::MatrixXd at_pins = u.middleRows(given_.patch.free_count, count_);
        const Eigen::FullPivLU<Eigen::MatrixXd> factor(at_pins.rightCols(count_));
        const auto pivots = factor.matrixLU().diagonal().cwiseAbs();
        if (!(pivots.minCoeff() > least_pivot * pivots.maxCoeff())) return std::nullopt;
        const Points normals = state_.normals.middleCols(given_.patch.free_count, count_);
        const VectorX wanted = to_go().cwiseProduct(normals).colwise().sum().transpose();
        const VectorX change = factor.solve(at_pins.col(0) - wanted);
        forces_ += change;
        return u.col(0) - u.rightCols(count_) * change;
    }

    std::optional<Points> step() {
        const auto rises = heights();
        if (!rises || !rises->allFinite()) return std::nullopt;
        const Points points = state_.points(Eigen::all, released_.to);
        const Points normals = state_.normals(Eigen::all, released_.to);
        Points d(3, problem_.patch.free_count);
        d << state_.moves(tangential_->displacement(points, normals), *rises), to_go();
        return d;
    }

    const Problem& given_;
    Indices pins_;
    int count_;
    Released released_;
    Problem problem_;  // the pins are free
    double radius_;
    const Progress& progress_;
    std::unique_ptr<NormalOperator> normal_;
    std::unique_ptr<TangentialStep> tangential_;  // the pins are fixed
    Anderson anderson_;
    Points targets_;  // of the pins
    VectorX forces_;  // λ
    Eigen::MatrixXd bells_;
    int bells_of_ = 0;    // surfaces they were measured on
    SurfaceState state_;  // of the released patch
    double contraction_ = 0.0;
    ShrinkingSteps steps_;
    Solution solution_;
};

}  // namespace

Indices isolated_pins(const Patch& patch) {
    Indices places;
    for (int v = patch.free_count; v < patch.vertex_count(); ++v) {
        const RingView ring = patch.ring(v);
        const bool alone =
            std::all_of(ring.vertices.begin(), ring.vertices.end(), [&](int u) { return patch.is_free(u); });
        if (patch.pin[v] && ring.closed() && alone) places.push_back(v - patch.free_count);
    }
    return places;
}

Solution spread_pins(const Problem& problem, double radius, const Points& start, const Progress& progress) {
    return SpreadPins(problem, radius, start, progress).run();
}

}  // namespace fairing
