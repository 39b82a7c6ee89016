#include "method/even.h"

#include "method/accept.h"
#include "method/direct.h"
#include "method/nested.h"
#include "method/polish.h"
#include "method/sizes.h"
#include "operators/workspace.h"
#include "placement/place.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

std::optional<Solution> solve_uniformly(const Problem& even, const Progress& progress) {
    std::optional<Solution> solution;
    if (is_large(even)) solution = solve_nested(even, progress);
    if (!solution) solution = try_directly(even, progress);
    if (flaw_of(even, *solution) != Flaw::absent) return std::nullopt;
    return solution;
}

}  // namespace

std::optional<Solution> solve_evenly(const Problem& problem, const Progress& progress) {
    Problem even = problem;
    even.weights = uniform_weights(problem.patch);
    auto solution = solve_uniformly(even, progress.range(0.0, 0.5));
    if (!solution) return std::nullopt;
    const SurfaceState state = measured_surface(even, solution->points);
    const TargetSurface target(problem.patch, state.points, state.normals);
    Workspace work{make_normal_operator(problem, state.points.leftCols(problem.patch.free_count)),
                   make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())};
    Placed placed = place_own(problem, *work.tangential, target, state.points, progress.here());
    const VectorX curvature = solution->mean_curvature;
    solution->mean_curvature = carried_over(placed.placement, target, curvature, problem);
    solution->points = placed.placement.points;
    solution->crossings.reset();
    solution->polished = false;
    refuse_folds(problem, placed, *solution);
    if (solution->termination == Termination::folded) return solution;
    const SolvedSurface surface{target, curvature, mean_edge(problem.patch, state.points), placed.placement.where};
    return polish(problem, work, std::move(*solution), surface, Hope::usual, progress.range(0.5, 1.0));
}

}  // namespace fairing
