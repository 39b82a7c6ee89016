#include "pins/spread_pins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "base/parallel.h"
#include "linear/anderson.h"
#include "operators/normal_operator.h"
#include "pins/released.h"
#include "problem/surface_state.h"
#include "tangential/tangential_step.h"

namespace fairing {

namespace {

constexpr int history_depth = 6;
constexpr double largest_step = 0.05;  // units of D
constexpr int most_iterations = 60;
constexpr int patience = 12;         // iterations without a shorter step
constexpr double reach = 5.0;        // radii: beyond, a Gaussian is less than 4e-6
constexpr double slow = 0.5;         // contraction that asks for a new factor
constexpr double least_pivot = 1e-8;  // of the largest: pins that act alike

Problem on_released(const Problem& problem, const Released& free, int pins) {
    Indices places;
    for (int v = problem.patch.free_count + pins; v < problem.patch.vertex_count(); ++v)
        places.push_back(free.from[at(v)] - problem.patch.free_count);
    return {free.patch,
            problem.fixed_points(Eigen::all, places),
            problem.fixed_normals(Eigen::all, places),
            uniform_weights(free.patch),
            problem.options};
}

class SpreadPins {
public:
    SpreadPins(const Problem& problem, double radius, const Points& start, const Progress& progress)
        : given_(problem),
          pins_(isolated_pins(problem.patch)),
          count_(static_cast<int>(pins_.size())),
          released_(released(problem.patch, pins_)),
          problem_(on_released(problem, released_, count_)),
          radius_(radius),
          progress_(progress),
          normal_(make_normal_operator(problem_, start(Eigen::all, released_.from).leftCols(released_.patch.free_count))),
          tangential_(make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())),
          anderson_(3L * problem.patch.free_count, history_depth),
          forces_(VectorX::Zero(count_)) {
        state_.points = start(Eigen::all, released_.from);
    }

    Solution run() {
        const int most = std::min(most_iterations, given_.options.max_iterations);
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
            if (!goes_on(largest, k)) return failed();
            accelerate(*d);
        }
        return finished();
    }

private:
    Solution finished() {
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
        const bool refresh = k == 0 || contraction_ > slow;
        return !refresh || normal_->update(state_.stiffness, progress_.here());
    }

    // Free count × pins.
    [[nodiscard]] Eigen::MatrixXd weighted_gaussians() const {
        Eigen::MatrixXd result = Eigen::MatrixXd::Zero(problem_.patch.free_count, count_);
        for (int k = 0; k < count_; ++k) {
            const int pin = given_.patch.free_count + k;
            for (int v : sheet_around(pin)) {
                const double away = (state_.points.col(v) - state_.points.col(pin)).squaredNorm();
                result(v, k) = state_.stiffness.mass[v] * std::exp(-0.5 * away / (radius_ * radius_));
            }
        }
        return result;
    }

    // The free vertices within reach of a pin that hang together with it there: not the far side of a thin wall.
    [[nodiscard]] Indices sheet_around(int pin) const {
        Indices found{pin};
        std::vector<char> seen(at(problem_.patch.vertex_count()), 0);
        seen[at(pin)] = 1;
        for (std::size_t k = 0; k < found.size(); ++k) {
            for (int u : problem_.patch.ring(found[k]).vertices) {
                if (seen[at(u)] || !problem_.patch.is_free(u)) continue;
                seen[at(u)] = 1;
                if ((state_.points.col(u) - state_.points.col(pin)).norm() < reach * radius_) found.push_back(u);
            }
        }
        return found;
    }

    // Heights along the normals that solve the equation to first order and are zero at the pins; nothing where pins
    // act alike.
    std::optional<VectorX> heights() {
        const Eigen::MatrixXd gaussians = weighted_gaussians();
        Eigen::MatrixXd rhs(problem_.patch.free_count, 1 + count_);
        rhs << outer_residual(problem_, state_) - gaussians * forces_, gaussians;
        solution_.residual = largest_residual(problem_, state_, rhs.col(0));
        const Eigen::MatrixXd u = normal_->solve(rhs);
        const Eigen::MatrixXd at_pins = u.middleRows(given_.patch.free_count, count_);
        const Eigen::FullPivLU<Eigen::MatrixXd> factor(at_pins.rightCols(count_));
        const auto pivots = factor.matrixLU().diagonal().cwiseAbs();
        if (!(pivots.minCoeff() > least_pivot * pivots.maxCoeff())) return std::nullopt;
        const VectorX change = factor.solve(at_pins.col(0));
        forces_ += change;
        return u.col(0) - u.rightCols(count_) * change;
    }

    std::optional<Points> step() {
        const auto rises = heights();
        if (!rises || !rises->allFinite()) return std::nullopt;
        const Points points = state_.points(Eigen::all, released_.to);
        const Points normals = state_.normals(Eigen::all, released_.to);
        Points d = tangential_->displacement(points, normals);
        for_ranges(given_.patch.free_count, coarse_grain, [&](int begin, int end) {
            for (int i = begin; i < end; ++i) {
                const Vector3 n = state_.normals.col(i);
                d.col(i) += ((*rises)[i] + state_.curvature.fit(i).rise(n, d.col(i))) * n;
            }
        });
        return d;
    }

    bool goes_on(double largest, int k) {
        if (!std::isfinite(largest)) return false;
        if (largest < least_step_) {
            least_step_ = largest;
            least_step_at_ = k;
        }
        return k - least_step_at_ <= patience;
    }

    void accelerate(const Points& d) {
        Eigen::Map<VectorX> x(state_.points.data(), 3L * given_.patch.free_count);
        VectorX step = anderson_.step(x, Eigen::Map<const VectorX>(d.data(), d.size()));
        const double largest = largest_length(Eigen::Map<const Points>(step.data(), 3, given_.patch.free_count));
        if (largest > largest_step) step *= largest_step / largest;
        x += step;
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
    VectorX forces_;  // λ
    SurfaceState state_;  // of the released patch
    double contraction_ = 0.0;
    double least_step_ = std::numeric_limits<double>::infinity();
    int least_step_at_ = 0;
    Solution solution_;
};

}  // namespace

Indices isolated_pins(const Patch& patch) {
    Indices places;
    for (int v = patch.free_count; v < patch.vertex_count(); ++v) {
        const RingView ring = patch.ring(v);
        const bool alone = std::all_of(ring.vertices.begin(), ring.vertices.end(), [&](int u) { return patch.is_free(u); });
        if (patch.pin[at(v)] && ring.closed() && alone) places.push_back(v - patch.free_count);
    }
    return places;
}

Solution spread_pins(const Problem& problem, double radius, const Points& start, const Progress& progress) {
    return SpreadPins(problem, radius, start, progress).run();
}

}  // namespace fairing
