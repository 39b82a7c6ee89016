#include "method/on_proxy.h"

#include "base/stopwatch.h"
#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "geometry/surface_fit.h"
#include "method/accept.h"
#include "method/polish.h"
#include "placement/place.h"
#include "solver/surface_state.h"

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
    if (placed.folded.size() > problem.tolerated_folds && proxy.converged()) {
        result.termination = Termination::folded;
        result.bad_triangles = placed.folded;
    }
    return result;
}

// Few folds: the mesh of a surface to begin a proxy from.
bool is_sound(const Patch& patch, const Points& points) {
    constexpr double tolerated_share = 0.02;
    return static_cast<double>(flipped_triangles(patch, points).size()) < tolerated_share * patch.triangle_count();
}

}  // namespace

Solution solve_on_proxy(const Problem& problem, const std::optional<Points>& guess, const Progress& progress) {
    Stopwatch watch;
    const Points membrane = proxy_membrane(problem, progress);
    const SurfaceState start = measured_surface(problem, membrane);
    const double fill_seconds = watch.lap();
    const bool sound = guess && is_sound(problem.patch, *guess);
    const SolvedProxy proxy = solve_proxy(problem, sound ? guess : std::nullopt, membrane, progress.range(0.0, 0.6));
    const double proxy_seconds = watch.lap();
    const TargetSurface target(proxy.mesh.patch, proxy.mesh.points, proxy.normals);
    Workspace work{make_normal_operator(problem),
                   make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())};
    const Placed placed = place(problem, *work.tangential, proxy, target, guess, progress.range(0.6, 0.8));
    Solution solution = placed_solution(problem, proxy, target, placed);
    const double placement_seconds = watch.lap();
    if (getenv("FDBG")) fprintf(stderr, "proxy conv=%d n=%d flips=%zu crosses=%d | placed folds=%zu ownflips=%zu cross=%zu\n", proxy.converged(), proxy.mesh.patch.free_count, flipped_by_solution(proxy.mesh.patch, proxy.mesh.points).size(), int(solution.crosses), placed.folded.size(), flipped_by_solution(problem.patch, solution.points).size(), crossing_triangles(problem.patch.triangles, solution.points).size());
    if (solution.termination == Termination::converged) {
        solution = polish(problem, work, std::move(solution), mean_edge(proxy.mesh.patch, proxy.mesh.points),
                          progress.range(0.8, 1.0));
    }
    solution.initial_residual = largest_residual(problem, start, outer_residual(problem, start));
    solution.seconds = {{"fill", fill_seconds},
                        {"proxy", proxy_seconds},
                        {"placement", placement_seconds},
                        {"polish", watch.lap()}};
    return solution;
}

}  // namespace fairing
