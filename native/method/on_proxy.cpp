#include "method/on_proxy.h"

#include "base/stopwatch.h"
#include "geometry/self_intersection.h"
#include "geometry/surface_fit.h"
#include "method/accept.h"
#include "method/polish.h"
#include "operators/workspace.h"
#include "placement/place.h"
#include "problem/surface_state.h"
#include "proxy/proxy_solver.h"

namespace fairing {

namespace {

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

// Whether the proxy begins from the surface of the user's own mesh. An iteration that ended nowhere may have left the
// surface, wrinkled, or have gone astray to a bulb, which tubes admit besides (a pipe of twelve radii whose ends lean
// by 30° grew to four). Between three outlines and more it was the surface in 20 of 20 blends, four times as fast as
// from the membrane and with fewer vertices off.
bool is_start(const Problem& problem, const OwnSurface& own) {
    constexpr int most_loops_of_tubes = 2;
    return own.solved || problem.patch.loop_count() > most_loops_of_tubes;
}

}  // namespace

Solution solve_on_proxy(const Problem& problem, const std::optional<OwnSurface>& guess, const Progress& progress) {
    Stopwatch watch;
    const Points membrane = proxy_membrane(problem, progress);
    const SurfaceState start = measured_surface(problem, membrane);
    const double fill_seconds = watch.lap();
    std::optional<Points> own;
    if (guess) own = guess->points;
    const SolvedProxy proxy = solve_proxy(problem, guess && is_start(problem, *guess) ? own : std::nullopt, membrane,
                                          progress.range(0.0, 0.6));
    const double proxy_seconds = watch.lap();
    const TargetSurface target(proxy.mesh.patch, proxy.mesh.points, proxy.normals);
    Workspace work{make_normal_operator(problem),
                   make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())};
    const auto put = proxy.converged() ? place : place_roughly;
    const Placed placed =
        put(problem, *work.tangential, {proxy.history, proxy.mesh, target}, own, progress.range(0.6, 0.8));
    Solution solution = placed_solution(problem, proxy, target, placed);
    const double placement_seconds = watch.lap();
    if (solution.termination == Termination::converged) {
        solution = polish(problem, work, std::move(solution), mean_edge(proxy.mesh.patch, proxy.mesh.points),
                          progress.range(0.8, 1.0));
    }
    solution.initial_residual = largest_residual(problem, start, outer_residual(problem, start));
    solution.seconds = {
        {"fill", fill_seconds}, {"proxy", proxy_seconds}, {"placement", placement_seconds}, {"polish", watch.lap()}};
    return solution;
}

}  // namespace fairing
