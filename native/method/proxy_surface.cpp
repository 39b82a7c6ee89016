#include "method/proxy_surface.h"

#include "geometry/neighbourhood.h"
#include "geometry/self_intersection.h"
#include "geometry/surface_fit.h"
#include "iteration/accelerated_iteration.h"
#include "method/levels.h"
#include "placement/first_placement.h"
#include "placement/relax.h"
#include "placement/tears.h"
#include "placement/untangle.h"
#include "problem/surface_state.h"
#include "tangential/slide.h"

namespace fairing {

namespace {

// A surface of the problem's own connectivity that another step has left, positions of all vertices.
struct OwnSurface {
    Points points;
    bool solved;  // the equation holds there

    // Whether a proxy mesh may begin from it. An iteration that ended nowhere may have left the surface, wrinkled, or
    // gone astray to a balloon, which tubes have too (a pipe of twelve radii whose ends lean by 30° grew to four).
    // Between three loops and more it was the surface in 20 of 20 blends, four times as fast as from the membrane and
    // with fewer vertices off.
    [[nodiscard]] bool is_start(const Problem& problem) const {
        constexpr int most_loops_of_tubes = 2;  // see above
        return solved || problem.patch.loop_count() > most_loops_of_tubes;
    }
};

std::optional<OwnSurface> left_by(const Attempts& attempts) {
    const Solution* own = attempts.own_connectivity();
    if (!own || !own->points.allFinite()) return std::nullopt;
    return OwnSurface{own->points, own->termination == Termination::converged};
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

// From this many free vertices on the low-passed loop shows what the surface is.
bool begins_low_passed(const Problem& problem, const Traits& traits) {
    return traits.is_large && traits.is_jagged && problem.patch.free_count >= smallest_telling &&
           problem.patch.loop_count() == 1;
}

// Free vertices of the level that a proxy mesh is made from: all of a small patch. A tube has several surfaces: a
// coarse level could lose the one that was solved.
int coarsest_for(const Problem& problem, const Traits& traits, const std::optional<OwnSurface>& guess) {
    const bool begins_coarse = traits.is_large && !(traits.is_tube && guess && guess->solved);
    return begins_coarse ? coarsest_size : problem.patch.free_count;
}

// Whether the equation is solved on the user's mesh, too, where that carries it.
enum class Polish { wanted, unwanted };

// Solves on a proxy mesh made from the coarsest level, projects the user's vertices level by level, and polishes: no
// system of the user's size is solved until the surface is known. Folds count on the finest level alone: coarse levels
// may have no placement without any.
class OnProxyMesh {
public:
    OnProxyMesh(const Problem& problem, int coarsest, const CoarseStart& start, const Progress& progress)
        : problem_(problem), start_(start), progress_(progress), levels_(problem, Boundaries::kept, coarsest) {}

    // `guess`: of the problem's patch. For a tube the membrane is the guess: placements from the proxy's history may
    // put its vertices on the wrong sheet. Where its start leads nowhere, a large patch has no better one.
    std::optional<Solution> run(const std::optional<OwnSurface>& guess, Polish polish) {
        const Points begin = start_.proxy ? start_.membrane : proxy_membrane(source(), progress_);
        const SurfaceState start = measured_surface(source(), begin);
        const int shown = problem_.patch.free_count;
        std::optional<Points> own;
        if (guess || problem_.patch.loop_count() == 2) own = guess ? on_source(guess->points) : begin;
        std::optional<SolvedProxy> proxy;
        if (guess && guess->is_start(problem_))
            proxy = solve_proxy_near(source(), *own, shown, progress_.range(0.0, 0.6));
        if (!proxy) proxy = solve_proxy(source(), start_.proxy, begin, shown, progress_.range(0.0, 0.6));
        if (!proxy) return std::nullopt;
        Solution solution = on_surface(*proxy, own, polish);
        solution.initial_residual = largest_residual(source(), start, outer_residual(source(), start));
        if (levels_.coarsest() > 0) solution.levels = levels_.sizes();
        return solution;
    }

private:
    [[nodiscard]] const Problem& source() const { return levels_.problem(levels_.coarsest()); }

    // The source's vertices of a surface of the problem's patch.
    [[nodiscard]] Points on_source(const Points& points) const {
        return levels_.coarsest() > 0 ? Points(points(Eigen::all, source().patch.to_input)) : points;
    }

    // Polished where the polished surface is accepted. Where the inner fairness alone folds triangles, a solve with it
    // would fold them, too.
    Solution on_surface(const SolvedProxy& proxy, const std::optional<Points>& own, Polish polish) {
        const TargetSurface target(proxy.mesh.patch, proxy.mesh.points, proxy.normals);
        const Projected best = projected(proxy, target, own);
        Solution solution = placed_solution(problem_, proxy, target, best);
        const bool may_polish = polish == Polish::wanted && solution.termination == Termination::converged;
        if (!may_polish || best.folded_by_springs > problem_.tolerated_folds) return solution;
        Workspace& work = levels_.work(0);
        work.normal = make_normal_operator(problem_, solution.points.leftCols(problem_.patch.free_count));
        const std::optional<Solution> polished = fairing::polished(problem_, work, solution, progress_.range(0.6, 1.0));
        const SolvedSurface surface{target, proxy.solution.mean_curvature,
                                    mean_edge(proxy.mesh.patch, proxy.mesh.points), best.placement.where};
        return polished && agree(problem_, *polished, surface) ? *polished : solution;
    }

    // From the guess, which has the right sheets, and from the history of the proxy mesh where folds stay then. Relaxed
    // by inner fairness where that folds nothing; else untangled from the unrelaxed coarsest vertices, if better.
    Projected projected(const SolvedProxy& proxy, const TargetSurface& target, const std::optional<Points>& own) {
        const bool is_set_up = levels_.work(0).tangential != nullptr;
        for (std::size_t k = levels_.coarsest() + 1; k-- > 0 && !is_set_up;) levels_.set_up_tangential(k, progress_);
        Projection projection(problem_, *levels_.work(0).tangential, target);
        const auto is_placed = [&](const Placement& start) {
            return projection.try_relaxed(spread(start, target)) || projection.try_as_is(unfolded(start, target));
        };
        if (!own || !is_placed(by_surface(source(), *own, proxy.mesh.patch, target)))
            is_placed(by_history(source(), proxy.history, proxy.mesh, target));
        return std::move(projection).best();
    }

    Placement spread(Placement placement, const TargetSurface& target) {
        relax(*levels_.work(levels_.coarsest()).tangential, target, placement);
        for (std::size_t k = levels_.coarsest(); k-- > 0;) {
            placement = on_finer_level(k, placement, target);
            slide_on(target, *levels_.work(k).tangential, most_slides, placement.where, placement.points);
        }
        return placement;
    }

    Placement unfolded(Placement placement, const TargetSurface& target) {
        for (std::size_t k = levels_.coarsest(); k-- > 0;) {
            untangle(levels_.problem(k + 1), target, placement);
            placement = on_finer_level(k, placement, target);
        }
        return placement;
    }

    // From level k + 1: removed vertices begin at the mean of their neighbours.
    [[nodiscard]] Placement on_finer_level(std::size_t k, const Placement& coarse, const TargetSurface& target) const {
        const Problem& fine = levels_.problem(k);
        const Transfer& transfer = levels_.transfer(k);
        const Removals& removals = transfer.removals;
        Points points = with_fixed(fine.patch, fine.fixed_points);
        std::vector<SurfacePoint> where(fine.patch.vertex_count());
        const int first_fixed = target.vertex_count() - static_cast<int>(fine.fixed_points.cols());
        for (int v = fine.patch.free_count; v < fine.patch.vertex_count(); ++v)
            where[v] = target.at_vertex(first_fixed + v - fine.patch.free_count);
        for (int c = 0; c < transfer.coarse_free_count; ++c) {
            where[transfer.coarse_in_fine[c]] = coarse.where[c];
            points.col(transfer.coarse_in_fine[c]) = coarse.points.col(c);
        }
        for (int r = removals.size(); r-- > 0;) {
            Vector3 mean = Vector3::Zero();
            int nearest = removals.neighbours[removals.begin[r]];
            for (int j = removals.begin[r]; j < removals.begin[r + 1]; ++j)
                mean += double{removals.weights[j]} * points.col(removals.neighbours[j]);
            for (int j = removals.begin[r]; j < removals.begin[r + 1]; ++j) {
                const int other = removals.neighbours[j];
                if ((points.col(other) - mean).squaredNorm() < (points.col(nearest) - mean).squaredNorm())
                    nearest = other;
            }
            const int v = removals.vertex[r];
            where[v] = target.project(mean, where[nearest].triangle);
            points.col(v) = target.position(where[v]);
        }
        where.resize(fine.patch.free_count);
        return {std::move(where), std::move(points)};
    }

    const Problem& problem_;
    const CoarseStart& start_;
    const Progress& progress_;
    Levels levels_;
};

std::optional<Solution> solve_on_proxy(const Problem& problem, const Traits& traits,
                                       const std::optional<OwnSurface>& guess, Polish polish, Attempts& attempts,
                                       const Progress& progress) {
    if (!attempts.start) attempts.start = std::make_shared<const CoarseStart>(problem, traits, progress);
    if (attempts.start->is_in_vain()) return std::nullopt;
    return OnProxyMesh(problem, coarsest_for(problem, traits, guess), *attempts.start, progress).run(guess, polish);
}

}  // namespace

CoarseStart::CoarseStart(const Problem& problem, const Traits& traits, const Progress& progress) {
    if (!begins_low_passed(problem, traits)) return;
    const Levels levels(traits.low_passed(), Boundaries::kept, coarsest_size);
    const Problem& coarsest = levels.problem(levels.coarsest());
    membrane = proxy_membrane(coarsest, progress);
    proxy.emplace(solve_coarse_proxy(coarsest, membrane, problem.patch.free_count, progress));
}

std::optional<Solution> solve_on_proxy_mesh(const Problem& problem, const Traits& traits, Attempts& attempts,
                                            const Progress& progress) {
    return solve_on_proxy(problem, traits, left_by(attempts), Polish::wanted, attempts, progress);
}

// Without polishing: the surface does not meet the problem's own boundary.
std::optional<Solution> solve_low_passed(const Problem& problem, const Traits& traits, Attempts& attempts,
                                         const Progress& progress) {
    const Problem& smooth = traits.low_passed();
    auto solution = solve_on_proxy(smooth, traits, std::nullopt, Polish::unwanted, attempts, progress);
    if (!solution) return std::nullopt;
    solution->points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    solution->points = untorn(problem.patch, std::move(solution->points));
    solution->provenance = Provenance::low_passed;
    return solution;
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

}  // namespace fairing
