#include "pins/spread_pins.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "base/errors.h"
#include "linear/anderson.h"
#include "linear/limits.h"
#include "linear/shrinking_steps.h"
#include "linear/sparse_cholesky.h"
#include "operators/normal_operator.h"
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

constexpr int steps = 8;  // of heat

// M + t S / 2, lower triangle: one implicit step of heat.
SparseMatrix heat_matrix(const Patch& patch, const Stiffness& stiffness, double time) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(patch.vertex_count() + patch.edge_count());
    for (int v = 0; v < patch.vertex_count(); ++v)
        entries.emplace_back(v, v, stiffness.mass[v] + 0.5 * time * stiffness.diagonal(patch, v));
    for (int e = 0; e < patch.edge_count(); ++e) {
        const auto [a, b] = patch.edge_ends[e];
        entries.emplace_back(std::max(a, b), std::min(a, b), -0.5 * time * stiffness.weights[e]);
    }
    SparseMatrix matrix(patch.vertex_count(), patch.vertex_count());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

// Pins first among the fixed vertices.
Indices order_of(const Patch& given, const Indices& pins) {
    Indices from(given.free_count);
    std::iota(from.begin(), from.end(), 0);
    std::vector<char> is_pin(given.vertex_count(), 0);
    for (int place : pins) {
        is_pin[given.free_count + place] = 1;
        from.push_back(given.free_count + place);
    }
    for (int v = given.free_count; v < given.vertex_count(); ++v) {
        if (!is_pin[v]) from.push_back(v);
    }
    return from;
}

// Cosine between a tip's axis and the normals around it, the mean by area; cos 60°. Hills that rise by half of D have
// .87 with 400 and more vertices, and .53 with 100.
constexpr double sharp = 0.5;

double mean_cosine(const Patch& patch, const Points& points, int v) {
    const std::span<const int> around = patch.ring(v).vertices;
    Vector3 sum = Vector3::Zero();
    double area = 0.0;
    for (std::size_t k = 0; k < around.size(); ++k) {
        const Vector3 a = points.col(around[k]) - points.col(v);
        const Vector3 b = points.col(around[(k + 1) % around.size()]) - points.col(v);
        const Vector3 face = a.cross(b);
        sum += face;
        area += face.norm();
    }
    return sum.norm() / area;
}

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

Eigen::MatrixXd bells(const Patch& patch, const Points& points, const Stiffness& stiffness, const Indices& centres,
                      double radius, const Progress& progress) {
    SparseCholesky factor(points);
    const double time = 0.5 * radius * radius / steps;
    if (!factor.factorise(heat_matrix(patch, stiffness, time), "pins", progress))
        throw SolverError("the radius of pins can't be measured on a surface that has degenerated");
    const auto count = static_cast<Eigen::Index>(centres.size());
    Eigen::MatrixXd heat = Eigen::MatrixXd::Zero(patch.vertex_count(), count);
    for (Eigen::Index k = 0; k < count; ++k) heat(centres[static_cast<std::size_t>(k)], k) = 1.0;
    for (int k = 0; k < steps; ++k) {
        if (k > 0) heat = stiffness.mass.asDiagonal() * heat;
        heat = factor.solve(heat);
    }
    for (Eigen::Index k = 0; k < count; ++k) heat.col(k) /= heat(centres[static_cast<std::size_t>(k)], k);
    return heat;
}

Released released(const Patch& given, const Indices& pins) {
    Indices from = order_of(given, pins);
    Indices to(from.size());
    for (int v = 0; v < static_cast<int>(from.size()); ++v) to[from[v]] = v;
    PatchMembers members;
    members.free_count = given.free_count + static_cast<int>(pins.size());
    for (int v : from) {
        members.to_input.push_back(given.to_input[v]);
        members.pin.push_back(given.pin[v]);
    }
    for (int v = 0; v < members.free_count; ++v) members.pin[v] = 0;
    members.input_triangle = given.input_triangle;
    members.triangles = given.triangles.unaryExpr([&](int v) { return to[v]; });
    return {Patch(std::move(members)), std::move(from), std::move(to)};
}

Problem on_released(const Problem& problem, const Released& free) {
    Indices places;
    for (int v = free.patch.free_count; v < free.patch.vertex_count(); ++v)
        places.push_back(free.from[v] - problem.patch.free_count);
    return {free.patch, problem.fixed_points(Eigen::all, places), problem.fixed_normals(Eigen::all, places),
            uniform_weights(free.patch), problem.options};
}

Indices sharp_pins(const Patch& patch, const Points& points) {
    Indices places = isolated_pins(patch);
    std::erase_if(places, [&](int place) { return !(mean_cosine(patch, points, patch.free_count + place) < sharp); });
    return places;
}

}  // namespace fairing
