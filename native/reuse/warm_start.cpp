#include "reuse/warm_start.h"

#include <algorithm>
#include <cmath>

#include "accept/accept.h"
#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "iteration/accelerated_iteration.h"
#include "problem/surface_state.h"
#include "problem/willmore.h"
#include "reuse/outline_move.h"
#include "start/clamped_fill.h"

namespace fairing {

namespace {

// This many more than the first solve with a factor took: it is time for a new one.
constexpr int tolerated_growth = 3;

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
    FaceGeometry faces;
    faces.update(points, patch_.triangles);
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
    normals_ = outline_of(problem).normals;
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
    const Outline present = outline_of(problem);
    if (present.points == points_.rightCols(count) && present.normals == normals_) return points_;
    const Outline last{points_.rightCols(count), normals_};
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
    // A minimal surface has another tangent plane at the outline: the last answer is a worse start than the outline.
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
    solution.ways = {{"warm", prediction + solution.seconds["iteration"]}};
    return solution;
}

}  // namespace fairing
