#include "method/on_own_mesh.h"

namespace fairing {

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
