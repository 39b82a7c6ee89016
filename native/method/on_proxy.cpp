#include "method/on_proxy.h"

#include "base/stopwatch.h"
#include "method/accept.h"
#include "method/placed_solution.h"
#include "method/polish.h"
#include "operators/workspace.h"
#include "placement/place.h"
#include "problem/surface_state.h"
#include "proxy/proxy_solver.h"

namespace fairing {

Solution solve_on_proxy(const Problem& problem, const std::optional<OwnSurface>& guess, const Progress& progress) {
    Stopwatch watch;
    const Points membrane = proxy_membrane(problem, progress);
    const SurfaceState start = measured_surface(problem, membrane);
    const double fill_seconds = watch.lap();
    std::optional<Points> own;
    if (guess) own = guess->points;
    const SolvedProxy proxy = solve_proxy(problem, guess && starts_from(problem, *guess) ? own : std::nullopt, membrane,
                                          problem.patch.free_count, progress.range(0.0, 0.6));
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
        solution = polish(problem, work, std::move(solution), surface_of(proxy, target, placed.placement), Hope::usual,
                          progress.range(0.8, 1.0));
    }
    solution.initial_residual = largest_residual(problem, start, outer_residual(problem, start));
    solution.seconds = {
        {"fill", fill_seconds}, {"proxy", proxy_seconds}, {"placement", placement_seconds}, {"polish", watch.lap()}};
    return solution;
}

std::optional<Solution> place_on_proxy(const Problem& problem, const Progress& progress) {
    const Points membrane = proxy_membrane(problem, progress);
    const SurfaceState start = measured_surface(problem, membrane);
    const SolvedProxy proxy =
        solve_proxy(problem, std::nullopt, membrane, problem.patch.free_count, progress.range(0.0, 0.8));
    if (!proxy.converged()) return std::nullopt;
    const TargetSurface target(proxy.mesh.patch, proxy.mesh.points, proxy.normals);
    const auto tangential = make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here());
    const Placed placed =
        place(problem, *tangential, {proxy.history, proxy.mesh, target}, std::nullopt, progress.range(0.8, 1.0));
    Solution solution = placed_solution(problem, proxy, target, placed);
    solution.initial_residual = largest_residual(problem, start, outer_residual(problem, start));
    return solution;
}

}  // namespace fairing
