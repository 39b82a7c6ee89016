#include "proxy/global_method.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "multigrid/nested_solve.h"
#include "proxy/placement.h"
#include "proxy/polish.h"
#include "proxy/proxy_solver.h"
#include "solver/continuation.h"
#include "solver/globalisation.h"
#include "solver/minimal_start.h"
#include "solver/normal_fill.h"
#include "solver/surface_state.h"
#include "variation/least_variation.h"

namespace fairing {

namespace {

// Large moves wrinkle a fine mesh, and a coarse proxy makes them for less: beyond this many free vertices it goes first
// (measured on hemispheres: 1.2 times slower at 20k, 1.4 times faster at 40k; at 100k only the proxy gets there).
constexpr int direct_limit = 25000;
// From here on it pays to begin on coarser levels.
constexpr int nested_limit = 1500;

double residual_of(const Problem& problem, const Points& points) {
    const SurfaceState state = measured_surface(problem, points);
    return largest_residual(problem, state, outer_residual(problem, state));
}

// The vertices of a surface, placed on it by their inner fairness.
Points settled(const Problem& problem, const Workspace& work, const Points& points) {
    const SurfaceState state = measured_surface(problem, points);
    const TargetSurface target(problem.patch, points, state.normals);
    Placement placement = at_vertices(problem, target, points);
    relax(problem, *work.tangential, target, placement);
    return placement.points;
}

// The start of the accurate iteration and what is reported about it.
struct Start {
    Points points;
    Points membrane;
    double initial_residual = 0.0;
    double fill_seconds = 0.0;
};

// The membrane depends on the outline's positions alone; the normals come in with the Willmore descent.
Start make_start(const Problem& problem, Workspace& work, const Progress& progress) {
    const Stopwatch watch;
    Start start{membrane(problem, work), {}};
    start.membrane = start.points;
    start.initial_residual = residual_of(problem, start.points);
    start.fill_seconds = watch.seconds();
    if (problem.options.equation == Equation::minimal) {
        start.points = descend_area(problem, work, start.points, progress);
        return start;
    }
    start.points = globalise(problem, work, start.points, progress);
    if (problem.patch.loop_count() < 2) return start;
    // Between loops the G1 data may admit several surfaces (a pipe longer than 2 π r): the one whose curvatures vary
    // least is wanted, so the start that varies least goes first.
    const auto along_normals = normal_fill(problem, progress.here());
    if (along_normals && curvature_variation(problem, *along_normals) < curvature_variation(problem, start.points)) {
        start.points = settled(problem, work, *along_normals);
    }
    return start;
}

// An iteration that fails may end anywhere: what is less bent is taken instead. A part of the load bends, too.
void keep_less_bent(const Problem& problem, const Points& candidate, Solution& solution) {
    if (problem.options.equation == Equation::minimal || solution.termination == Termination::converged) return;
    if (solution.reached_load > 0.0) return;
    if (willmore_energy(problem, solution.points) <= willmore_energy(problem, candidate)) return;
    const SurfaceState state = measured_surface(problem, candidate);
    solution.points = candidate;
    solution.mean_curvature = state.curvature.mean;
    solution.residual = largest_residual(problem, state, outer_residual(problem, state));
}

// The solve on the user's mesh alone, from the membrane.
Solution solve_directly(const Problem& problem, const Progress& progress) {
    Stopwatch watch;
    Workspace work{
        make_normal_operator(problem),
        make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.range(0.0, 0.05))};
    const Start start = make_start(problem, work, progress.range(0.05, 0.6));
    const double start_seconds = watch.lap();
    Solution solution = solve_equation(problem, work, start.points, progress.range(0.6, 1.0));
    for (const Points* candidate : {&start.points, &start.membrane}) keep_less_bent(problem, *candidate, solution);
    solution.boundary_normals = one_sided_normals(problem.patch, solution.points);
    solution.initial_residual = start.initial_residual;
    solution.seconds = {{"fill", start.fill_seconds},
                        {"globalisation", start_seconds - start.fill_seconds},
                        {"iteration", watch.lap()}};
    return solution;
}

// The fast path has led to a surface that can be relied on. Many iterations are a sign of trouble: on graded meshes the
// discrete equation may have solutions that are none of the surface's (1e-3 D off a sphere after 100 iterations, 2e-3 D
// off a cylinder after 29; the usual number is 8 to 20).
bool is_trustworthy(const Problem& problem, const Solution& direct) {
    constexpr int most_iterations = 20;
    return direct.termination == Termination::converged && direct.iterations <= most_iterations &&
           !has_poor_triangles(problem.patch, direct.points);
}

// The mesh carries the equation, but not with the whole load: other meshes wouldn't either.
bool ended_by_load(const Problem& problem, const Solution& direct) {
    return direct.reached_load > 0.0 && !has_poor_triangles(problem.patch, direct.points);
}

// The direct solve as a fast path: left at the first sign of trouble, since the proxy comes next.
Solution try_directly(const Problem& problem, const Progress& progress) {
    constexpr int patience = 12;  // near clusters of valence 3 it took up to 7
    constexpr int most_iterations = 60;
    Problem attempt = problem;
    attempt.options.patience = patience;
    attempt.options.max_iterations = std::min(problem.options.max_iterations, most_iterations);
    Solution solution = solve_directly(attempt, progress);
    const bool by_own_limit = attempt.options.max_iterations < problem.options.max_iterations;
    if (solution.termination == Termination::iteration_limit && by_own_limit) {
        solution.termination = Termination::stalled;
    }
    return solution;
}

// The converged one; where neither has converged, the less bent one. Residuals of two meshes can't be compared.
Solution better_of(const Problem& problem, Solution direct, Solution on_proxy) {
    const bool direct_converged = direct.termination == Termination::converged;
    const bool proxy_converged = on_proxy.termination == Termination::converged;
    const bool proxy_wins = direct_converged != proxy_converged
                                ? proxy_converged
                                : direct_converged || !(willmore_energy(problem, direct.points) <=
                                                        willmore_energy(problem, on_proxy.points));
    return proxy_wins ? std::move(on_proxy) : std::move(direct);
}

bool is_uniform(const Lambda& weights) {
    const auto* edges = std::get_if<InnerWeights>(&weights);
    return edges && std::all_of(edges->begin(), edges->end(),
                                [&](const WeightedEdge& edge) { return edge.weight == edges->front().weight; });
}

// From coarse to fine where the patch is large enough for that to pay.
std::optional<Solution> try_nested(const Problem& problem, const Progress& progress) {
    if (!problem.options.nested || problem.patch.free_count <= nested_limit) return std::nullopt;
    auto nested = solve_nested(problem, solve_global, progress);
    if (!nested || has_poor_triangles(problem.patch, nested->points)) return std::nullopt;
    return nested;
}

// With uniform weights, if the mesh carries the equation then.
std::optional<Solution> solve_uniformly(const Problem& even, const Progress& progress) {
    if (auto nested = try_nested(even, progress.range(0.0, 0.5))) return nested;
    if (even.patch.free_count > direct_limit) return std::nullopt;
    Solution direct = try_directly(even, progress.range(0.5, 1.0));
    if (!is_trustworthy(even, direct)) return std::nullopt;
    return direct;
}

// The shape doesn't depend on λ: where a mesh carries the equation with its vertices evenly placed only, that surface
// is taken and λ places them on it. Nothing where even that doesn't converge.
std::optional<Solution> solve_evenly(const Problem& problem, const Progress& progress) {
    if (is_uniform(problem.weights)) return std::nullopt;
    Problem even = problem;
    even.weights = uniform_weights(problem.patch);
    auto solution = solve_uniformly(even, progress.range(0.0, 0.5));
    if (!solution) return std::nullopt;
    const SurfaceState state = measured_surface(even, solution->points);
    const TargetSurface target(problem.patch, state.points, state.normals);
    Placement placement = at_vertices(problem, target, state.points);
    Workspace work{make_normal_operator(problem, placement.points.leftCols(problem.patch.free_count)),
                   make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())};
    settle(problem, *work.tangential, target, placement, progress.here());
    solution->mean_curvature = carried_over(placement, target, solution->mean_curvature, problem);
    solution->points = std::move(placement.points);
    solution->polished = false;
    return polish(problem, work, std::move(*solution), progress.range(0.5, 1.0));
}

}  // namespace

Solution solve_global(const Problem& problem, const Progress& progress) {
    if (problem.options.equation == Equation::least_variation) return solve_least_variation(problem, progress);
    if (problem.options.equation == Equation::minimal) return solve_directly(problem, progress);
    // A large patch is resolved best by its own mesh, a small one by the proxy.
    const bool large = problem.patch.free_count > nested_limit;
    if (auto nested = try_nested(problem, progress)) return std::move(*nested);
    if (large) {
        if (auto even = solve_evenly(problem, progress.range(0.0, 0.3))) return std::move(*even);
    }
    if (problem.patch.free_count > direct_limit) {
        Solution on_proxy = solve_on_proxy(problem, std::nullopt, progress);
        if (on_proxy.termination == Termination::converged) return on_proxy;
        return better_of(problem, solve_directly(problem, progress), std::move(on_proxy));
    }
    Solution direct = try_directly(problem, progress.range(0.3, 0.5));
    if (is_trustworthy(problem, direct) || ended_by_load(problem, direct)) return direct;
    std::optional<Points> guess;
    if (direct.termination == Termination::converged) guess = direct.points;
    Solution on_proxy = solve_on_proxy(problem, guess, progress.range(0.5, 0.9));
    const bool neither = direct.termination != Termination::converged && on_proxy.termination != Termination::converged;
    if (neither && !large) {
        if (auto even = solve_evenly(problem, progress.range(0.9, 1.0))) return std::move(*even);
    }
    return better_of(problem, std::move(direct), std::move(on_proxy));
}

}  // namespace fairing
