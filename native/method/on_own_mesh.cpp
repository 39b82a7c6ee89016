#include "method/on_own_mesh.h"

#include <algorithm>

#include "geometry/averages.h"
#include "geometry/self_intersection.h"
#include "geometry/surface_fit.h"
#include "iteration/accelerated_iteration.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

// The last digits come unevenly: on a graded hemisphere of 5,000 vertices no step from 1e-9 D on was the shortest for
// more than four. A cap of 140° is solved in 45 steps.
Problem for_few_steps(const Problem& problem) {
    Problem result = problem;
    result.conduct.limits = problem.options.tolerance < SolverOptions{}.tolerance ? brisk : nearby;
    return result;
}

}  // namespace

// An iteration that ended nowhere may have left the surface, wrinkled, or gone astray to a balloon, which tubes have
// too (a pipe of twelve radii whose ends lean by 30° grew to four). Between three loops and more it was the surface
// in 20 of 20 blends, four times as fast as from the membrane and with fewer vertices off.
bool OwnSurface::is_start(const Problem& problem) const {
    constexpr int most_loops_of_tubes = 2;  // see above
    return solved || problem.patch.loop_count() > most_loops_of_tubes;
}

Solution placed_solution(const Problem& problem, const SolvedProxy& proxy, const TargetSurface& target,
                         const Placed& placed) {
    Solution result = proxy.solution;
    result.polished = false;
    result.points = placed.placement.points;
    result.boundary_normals = one_sided_normals(proxy.mesh.patch, proxy.mesh.points);
    result.mean_curvature = carried_over(placed.placement, target, proxy.solution.mean_curvature, problem);
    result.crosses = !crossing_triangles(proxy.mesh.patch.triangles, proxy.mesh.points).empty();
    if (proxy.converged()) refuse_folds(problem, placed, result);
    return result;
}

Solution polished(const Problem& problem, Workspace& work, Solution placed, const SolvedSurface& surface,
                  const Progress& progress) {
    Solution own = iterate(for_few_steps(problem), work, placed.points, progress);
    if (own.termination != Termination::converged || !agree(problem, own, surface)) return placed;
    own.boundary_normals = one_sided_normals(problem.patch, own.points);
    own.from_surface = true;
    own.crosses = placed.crosses;
    return flaw_of(problem, own) == Flaw::absent ? own : placed;
}

SolvedSurface surface_of(const SolvedProxy& proxy, const TargetSurface& target, const Placement& placement) {
    return {target, proxy.solution.mean_curvature, mean_edge(proxy.mesh.patch, proxy.mesh.points), placement.where};
}

std::optional<Solution> OnOwnMesh::run(const std::optional<OwnSurface>& guess, Polish polish) {
    Stopwatch watch;
    std::map<std::string, double> seconds;
    const Points begin = membrane();
    const SurfaceState start = measured_surface(source(), begin);
    std::optional<Points> own;
    if (guess) own = on_source(guess->points);
    seconds["fill"] = watch.lap();
    const SolvedProxy proxy = solved_proxy(guess && guess->is_start(problem_) ? own : std::nullopt, begin);
    seconds["proxy"] = watch.lap();
    if (polish == Polish::unwanted && !proxy.converged()) return std::nullopt;
    const TargetSurface target(proxy.mesh.patch, proxy.mesh.points, proxy.normals);
    const Placed best = placed(proxy, target, own);
    Solution solution = placed_solution(problem_, proxy, target, best);
    seconds["placement"] = watch.lap();
    if (polish == Polish::wanted && solution.termination == Termination::converged && may_polish(best))
        solution = on_users_mesh(std::move(solution), surface_of(proxy, target, best.placement));
    seconds["polish"] = watch.lap();
    solution.initial_residual = largest_residual(source(), start, outer_residual(source(), start));
    solution.seconds = std::move(seconds);
    return solution;
}

}  // namespace fairing
