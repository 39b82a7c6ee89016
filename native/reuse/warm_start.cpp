#include "reuse/warm_start.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "accept/accept.h"
#include "base/errors.h"
#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "iteration/accelerated_iteration.h"
#include "iteration/continuation.h"
#include "problem/surface_state.h"
#include "start/clamped_fill.h"
#include "variation/least_variation.h"

namespace fairing {

namespace {

// This many more than the first solve with a factor took: it is time for a new one.
constexpr int tolerated_growth = 3;

class NoStep : public TangentialStep {
public:
    explicit NoStep(const Points& points) : points_(points) {}
    void hold(const Points& /*fixed_points*/) override {}
    [[nodiscard]] Points harmonic_positions() const override { return points_; }
    [[nodiscard]] double merit(const Points& /*points*/) const override { return 0.0; }
    using TangentialStep::displacement;
    [[nodiscard]] double imbalance(const Points& /*points*/, const Points& /*normals*/) const override { return 0.0; }
    [[nodiscard]] Points displacement(const Points& /*points*/, const TangentPlanes& /*planes*/,
                                      Effort /*effort*/) const override {
        return Points::Zero(3, points_.cols());
    }

private:
    Points points_;  // 3 × free count
};

std::optional<Solution> accepted(const Problem& problem, Solution solution, const StrategyTried& strategy) {
    if (solution.termination != Termination::converged) return std::nullopt;
    solution.flaw = flaw_of(problem, solution);
    if (solution.flaw != Flaw::absent) return std::nullopt;
    solution.strategies = {strategy};
    return solution;
}

// On a mesh of its own.
std::optional<Solution> vary_least_near(const Problem& problem, const Points& points, const Progress& progress) {
    const Stopwatch watch;
    VariationLimits limits;
    limits.near = NearVariation{points, false};
    std::optional<Solution> solution;
    try {
        solution = solve_less_varying(problem, limits, progress);
    } catch (const SolverError&) {
        return std::nullopt;
    }
    return solution ? accepted(problem, std::move(*solution), {"variation", watch.seconds()}) : std::nullopt;
}

constexpr double farthest_move = 0.05;      // units of D
constexpr double cos_of_widest_turn = 0.7;  // 45°

// The rotation that brings directions, or centred places, nearest to others.
Eigen::Matrix3d best_rotation(const Points& from, const Points& to) {
    const Eigen::Matrix3d covariance = to * from.transpose();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d U = svd.matrixU();
    if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) = -U.col(2);
    return U * svd.matrixV().transpose();
}

// Fixed points, and normals with a small weight: they decide where the points lie on a line.
Points placed_and_turned(const Points& points, const Points& normals) {
    constexpr double weight = 1e-2;  // beside places
    Points both(3, points.cols() + normals.cols());
    both << points, weight * normals;
    return both;
}

bool turned_too_far(const Points& from, const Points& to) {
    for (Eigen::Index k = 0; k < from.cols(); ++k) {
        if (from.col(k).dot(to.col(k)) < cos_of_widest_turn * from.col(k).squaredNorm()) return true;
    }
    return false;
}

}  // namespace

void WarmStart::choose_operator(const Problem& problem) {
    const bool minimal = problem.options.equation == Equation::soap_film;
    if (work_.normal && is_laplacian_ == minimal) return;
    is_laplacian_ = minimal;
    work_.keeps_factor = false;
    work_.normal = make_normal_operator(problem);
}

bool WarmStart::factorise(const Problem& problem, const Points& points, const Progress& progress) {
    choose_operator(problem);
    work_.keeps_factor = false;  // Cancelled leaves none
    iterations_at_first_ = 0;
    history_.reset();
    FaceGeometry faces(points, patch_.triangles);
    factorised_.update(faces, patch_);
    work_.keeps_factor = work_.normal->update(factorised_, progress);
    return work_.keeps_factor;
}

void WarmStart::hold(const Problem& problem, const Progress& progress) {
    if (work_.tangential) {
        work_.tangential->hold(problem.fixed_points);
    } else {
        work_.tangential = make_tangential_step(patch_, problem.weights, problem.fixed_points, progress.here());
    }
}

void WarmStart::remember(const Problem& problem, const Solution& solution, const Progress& progress) {
    ready_ = false;
    choose_operator(problem);
    if (!solution.polished || solution.flaw != Flaw::absent || has_poor_triangles(patch_, solution.points)) return;
    if (!work_.keeps_factor && !factorise(problem, solution.points, progress.here())) return;
    hold(problem, progress);
    if (work_.history) history_ = std::move(work_.history);
    points_ = solution.points;
    normals_ = boundary_of(problem).normals;
    ready_ = true;
}

Points WarmStart::continued(const Problem& problem, const Points& fixed_displacement,
                            const Points& conormal_change) const {
    if (problem.options.equation != Equation::soap_film) {
        return clamped_displacement(patch_, factorised_, fixed_displacement, conormal_change, *work_.normal);
    }
    Points field = Points::Zero(3, patch_.vertex_count());
    field.rightCols(fixed_displacement.cols()) = fixed_displacement;
    const Points rhs = -factorised_.apply(patch_, field, patch_.free_count);
    return work_.normal->solve(rhs.transpose()).transpose();
}

std::optional<Points> WarmStart::moved_along(const Problem& problem) const {
    const Eigen::Index count = problem.fixed_points.cols();
    const Boundary present = boundary_of(problem);
    if (present.points == points_.rightCols(count) && present.normals == normals_) return points_;
    const Boundary last{points_.rightCols(count), normals_};
    const auto rotation = small_rotation(last, present);
    if (!rotation) return std::nullopt;
    Points result = *rotation * points_;
    const Points from_normals = *rotation * normals_;
    const Points from_points = result.rightCols(count);
    const Points move = problem.fixed_points - from_points;
    const Points conormal_change =
        conormals(patch_, problem.fixed_points, present.normals) - conormals(patch_, from_points, from_normals);
    result.leftCols(patch_.free_count) += continued(problem, move, conormal_change);
    result.rightCols(count) = problem.fixed_points;
    return result;
}

void WarmStart::watch_factor(int iterations) {
    if (iterations_at_first_ == 0) iterations_at_first_ = iterations;
    if (iterations > iterations_at_first_ + tolerated_growth) work_.keeps_factor = false;
}

Solution WarmStart::iterate_from(const Problem& problem, const Points& start, const Progress& progress) {
    Problem attempt = problem;
    attempt.conduct.limits = nearby;
    work_.history = history_ ? std::make_unique<Anderson>(*history_) : nullptr;
    Solution solution = iterate(attempt, work_, start, progress);
    if (solution.termination != Termination::converged) work_.history.reset();
    return solution;
}

std::optional<Solution> WarmStart::solve(const Problem& problem, const Progress& progress) {
    // A minimal surface has another tangent plane at the boundary: the last answer is a worse start than the boundary.
    if (!ready_ || is_laplacian_ != (problem.options.equation == Equation::soap_film)) return std::nullopt;
    Stopwatch watch;
    if (!work_.keeps_factor && !factorise(problem, points_, progress.here())) return std::nullopt;
    const std::optional<Points> start = moved_along(problem);
    if (!start) return std::nullopt;
    hold(problem, progress);
    const double prediction = watch.lap();
    Solution solution = iterate_from(problem, *start, progress.range(0.0, 0.5));
    if (solution.termination != Termination::converged) {
        if (!factorise(problem, *start, progress.here())) return std::nullopt;
        solution = iterate_from(problem, *start, progress.range(0.5, 1.0));
    }
    if (solution.termination != Termination::converged) return std::nullopt;
    watch_factor(solution.iterations);
    solution.boundary_normals = one_sided_normals(patch_, solution.points);
    // Only an answer without folds counts as the one that a solve from the boundary alone would give.
    solution.flaw = flaw_of(problem, solution);
    if (solution.flaw != Flaw::absent) return std::nullopt;
    solution.seconds = {{"prediction", prediction}, {"iteration", watch.lap()}};
    solution.strategies = {{"warm", prediction + solution.seconds["iteration"]}};
    return solution;
}

std::optional<Solution> solve_near(const Problem& problem, const NearStart& start, const Progress& progress) {
    if (problem.options.equation == Equation::least_variation) return vary_least_near(problem, start.points, progress);
    const Stopwatch watch;
    Problem attempt = problem;
    attempt.conduct.limits = nearby;
    const Points free_points = start.points.leftCols(problem.patch.free_count);
    Workspace work{make_normal_operator(attempt, free_points), nullptr};
    if (start.converged) {
        work.tangential = std::make_unique<NoStep>(free_points);
    } else {
        work.tangential = make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here());
    }
    Solution solution;
    try {
        solution = solve_equation(attempt, work, start.points, progress);
    } catch (const SolverError&) {
        return std::nullopt;  // a start without a factor: the other strategies don't need it
    }
    if (solution.termination != Termination::converged) return std::nullopt;
    solution.boundary_normals = one_sided_normals(problem.patch, solution.points);
    solution.seconds = {{"iteration", watch.seconds()}};
    return accepted(problem, std::move(solution), {"near", watch.seconds()});
}

Boundary boundary_of(const Problem& problem) {
    const Patch& patch = problem.patch;
    Boundary result{problem.fixed_points, problem.fixed_normals};
    for (Eigen::Index k = 0; k < result.normals.cols(); ++k) {
        if (patch.pin[patch.free_count + static_cast<int>(k)]) result.normals.col(k).setZero();
    }
    return result;
}

std::optional<Eigen::Matrix3d> small_rotation(const Boundary& last, const Boundary& present) {
    const Eigen::Matrix3d rotation =
        best_rotation(placed_and_turned(last.points, last.normals), placed_and_turned(present.points, present.normals));
    if (!(largest_length(present.points - rotation * last.points) <= farthest_move)) return std::nullopt;
    if (turned_too_far(rotation * last.normals, present.normals)) return std::nullopt;
    return rotation;
}

}  // namespace fairing
