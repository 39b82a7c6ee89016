#include "method/proxy_surface.h"

#include "geometry/neighbourhood.h"
#include "geometry/self_intersection.h"
#include "geometry/surface_fit.h"
#include "iteration/accelerated_iteration.h"
#include "method/coarse_proxy.h"
#include "placement/relax.h"
#include "placement/tears.h"

namespace fairing {

namespace {

// A tube has several surfaces: a coarse level could lose the one that was solved.
bool begins_coarse(const Traits& traits, const std::optional<OwnSurface>& guess) {
    return traits.is_large && !(traits.is_tube && guess && guess->solved);
}

std::optional<OwnSurface> left_by(const Attempts& attempts) {
    const Solution* own = attempts.own_connectivity();
    if (!own || !own->points.allFinite()) return std::nullopt;
    return OwnSurface{own->points, own->termination == Termination::converged};
}

// On a mesh made from the problem's own connectivity.
class FineOwnMesh final : public OnOwnMesh {
public:
    FineOwnMesh(const Problem& problem, const Progress& progress) : OnOwnMesh(problem, progress) {}

private:
    [[nodiscard]] const Problem& source() const override { return problem_; }
    [[nodiscard]] Points membrane() const override { return proxy_membrane(problem_, progress_); }
    [[nodiscard]] Points on_source(const Points& points) const override { return points; }

    Projected projected(const SolvedProxy& proxy, const TargetSurface& target,
                        const std::optional<Points>& own) override {
        if (!work_.tangential)
            work_.tangential =
                make_tangential_step(problem_.patch, problem_.weights, problem_.fixed_points, progress_.here());
        return place(problem_, *work_.tangential, {proxy.history, proxy.mesh, target}, own);
    }

    std::optional<Solution> on_users_mesh(const Solution& projected) override {
        work_.normal = make_normal_operator(problem_);
        return polished(problem_, work_, projected, progress_.range(0.8, 1.0));
    }

    Workspace work_;
};

// Found once for all steps.
const CoarseStart& start_of(const Problem& problem, const Traits& traits, Attempts& attempts,
                            const Progress& progress) {
    if (!attempts.start) attempts.start = std::make_shared<const CoarseStart>(problem, traits, progress);
    return *attempts.start;
}

// Without polishing: for a surface that does not meet the problem's own boundary. `traits`, `attempts`: of the problem
// whose loops may have been low-passed since.
std::optional<Solution> project_onto_proxy_mesh(const Problem& problem, const Traits& traits, Attempts& attempts,
                                                const Progress& progress) {
    if (!traits.is_large) return FineOwnMesh(problem, progress).run(std::nullopt, Polish::unwanted);
    return solve_on_coarse_proxy(problem, std::nullopt, Polish::unwanted, start_of(problem, traits, attempts, progress),
                                 progress);
}

// The projected vertices joined to a boundary that lies off their surface by `offsets`. The rows next to it follow it,
// or stay where that tears fewer triangles.
Points beside(const Patch& patch, const Points& offsets, const Points& projected) {
    Points followed = projected;
    follow_boundary(patch, offsets, followed);
    followed = untorn(patch, std::move(followed));
    const std::size_t torn = torn_triangles(patch, followed).size();
    if (torn == 0) return followed;
    Points kept = projected;
    kept.rightCols(offsets.cols()) += offsets;
    kept = untorn(patch, std::move(kept));
    return torn_triangles(patch, kept).size() < torn ? kept : followed;
}

// Near 1e-9 D steps shrink unevenly (a graded hemisphere of 5,000 vertices), so tight tolerances get more steps in
// vain. A cap of 140° takes 45 steps.
Problem for_few_steps(const Problem& problem) {
    Problem result = problem;
    result.conduct.limits = problem.options.tolerance < SolverOptions{}.tolerance ? brisk : nearby;
    result.conduct.contracts = true;
    return result;
}

// The user's vertices as they were projected onto a proxy (`target`), with its H and normals; `folded` where no
// placement without folds was found.
Solution placed_solution(const Problem& problem, const SolvedProxy& proxy, const TargetSurface& target,
                         const Projected& projected) {
    Solution result = proxy.solution;
    result.polished = false;
    result.points = projected.placement.points;
    result.boundary_normals = one_sided_normals(proxy.mesh.patch, proxy.mesh.points);
    result.mean_curvature = carried_over(projected.placement, target, proxy.solution.mean_curvature, problem);
    result.crosses = !crossing_triangles(proxy.mesh.patch.triangles, proxy.mesh.points).empty();
    refuse_folds(problem, projected, result);
    return result;
}

}  // namespace

std::optional<Solution> solve_on_proxy_mesh(const Problem& problem, const Traits& traits, Attempts& attempts,
                                            const Progress& progress) {
    const auto guess = left_by(attempts);
    if (!begins_coarse(traits, guess)) return FineOwnMesh(problem, progress).run(guess, Polish::wanted);
    return solve_on_coarse_proxy(problem, guess, Polish::wanted, start_of(problem, traits, attempts, progress),
                                 progress);
}

std::optional<Solution> solve_low_passed(const Problem& problem, const Traits& traits, Attempts& attempts,
                                         const Progress& progress) {
    const Problem& smooth = traits.low_passed();
    auto solution = project_onto_proxy_mesh(smooth, traits, attempts, progress);
    if (!solution) return std::nullopt;
    solution->points = beside(problem.patch, problem.fixed_points - smooth.fixed_points, solution->points);
    solution->provenance = Provenance::low_passed;
    return solution;
}

// An iteration that ended nowhere may have left the surface, wrinkled, or gone astray to a balloon, which tubes have
// too (a pipe of twelve radii whose ends lean by 30° grew to four). Between three loops and more it was the surface
// in 20 of 20 blends, four times as fast as from the membrane and with fewer vertices off.
bool OwnSurface::is_start(const Problem& problem) const {
    constexpr int most_loops_of_tubes = 2;  // see above
    return solved || problem.patch.loop_count() > most_loops_of_tubes;
}

std::optional<Solution> polished(const Problem& problem, Workspace& work, const Solution& projected,
                                 const Progress& progress) {
    Solution own = iterate(for_few_steps(problem), work, projected.points, progress);
    if (own.termination != Termination::converged) return std::nullopt;
    own.boundary_normals = one_sided_normals(problem.patch, own.points);
    own.from_surface = true;
    own.crosses = projected.crosses;
    if (flaw_of(problem, own) != Flaw::absent) return std::nullopt;
    return own;
}

// The user's vertices on a proxy's surface, polished where the polished surface is accepted. Where springs alone fold
// triangles, the equation's solution by them would be folded, too.
Solution OnOwnMesh::on_surface(const SolvedProxy& proxy, const std::optional<Points>& own, Polish polish) {
    const TargetSurface target(proxy.mesh.patch, proxy.mesh.points, proxy.normals);
    const Projected best = projected(proxy, target, own);
    Solution solution = placed_solution(problem_, proxy, target, best);
    const bool may_polish = polish == Polish::wanted && solution.termination == Termination::converged;
    if (!may_polish || best.folded_by_springs > problem_.tolerated_folds) return solution;
    const std::optional<Solution> polished = on_users_mesh(solution);
    const SolvedSurface surface{target, proxy.solution.mean_curvature, mean_edge(proxy.mesh.patch, proxy.mesh.points),
                                best.placement.where};
    return polished && agree(problem_, *polished, surface) ? *polished : solution;
}

// For a tube the membrane is the guess: placements from the proxy's history may put its vertices on the wrong sheet.
std::optional<Solution> OnOwnMesh::run(const std::optional<OwnSurface>& guess, Polish polish) {
    const Points begin = membrane();
    const SurfaceState start = measured_surface(source(), begin);
    const int shown = problem_.patch.free_count;
    std::optional<Points> own;
    if (guess || problem_.patch.loop_count() == 2) own = guess ? on_source(guess->points) : begin;
    std::optional<SolvedProxy> proxy;
    if (guess && guess->is_start(problem_)) proxy = solve_proxy_near(source(), *own, shown, progress_.range(0.0, 0.6));
    if (!proxy) proxy = solve_proxy(source(), known_proxy(), begin, shown, progress_.range(0.0, 0.6));
    if (!proxy) return std::nullopt;
    Solution solution = on_surface(*proxy, own, polish);
    solution.initial_residual = largest_residual(source(), start, outer_residual(source(), start));
    return solution;
}

}  // namespace fairing
