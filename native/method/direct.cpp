#include "method/direct.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "geometry/averages.h"
#include "geometry/surface_fit.h"
#include "iteration/continuation.h"
#include "operators/workspace.h"
#include "placement/relax.h"
#include "problem/surface_state.h"
#include "start/area_descent.h"
#include "start/globalisation.h"
#include "start/membrane.h"
#include "start/normal_fill.h"
#include "start/several_outlines.h"

namespace fairing {

namespace {

double residual_of(const Problem& problem, const Points& points) {
    const SurfaceState state = measured_surface(problem, points);
    return largest_residual(problem, state, outer_residual(problem, state));
}

// The vertices of a surface, placed on it by their inner fairness.
Points settled(const Problem& problem, const Workspace& work, const Points& points) {
    const SurfaceState state = measured_surface(problem, points);
    const TargetSurface target(problem.patch, points, state.normals);
    Placement placement = at_vertices(problem, target, points);
    relax(*work.tangential, target, placement);
    return placement.points;
}

// Of a surface that is only a start they have to tell no more than whether it meets its outline from behind, and fits
// take a quarter of its time.
Points boundary_normals(const Problem& problem, const Points& points) {
    const Patch& patch = problem.patch;
    if (!problem.conduct.start_only) return one_sided_normals(patch, points);
    return averaged_normals(points, patch.triangles).rightCols(patch.vertex_count() - patch.free_count);
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
    if (problem.options.equation == Equation::soap_film) {
        start.points = descend_area(problem, work, start.points, progress);
        return start;
    }
    start.points = globalise(problem, work, start.points, progress);
    if (!may_fit_several(problem.patch, start.points)) return start;
    // The one whose curvatures vary least is wanted, so the start that varies least goes first.
    const auto along_normals = normal_fill(problem, progress.here());
    if (along_normals && curvature_variation(problem, *along_normals) < curvature_variation(problem, start.points)) {
        start.points = settled(problem, work, *along_normals);
    }
    return start;
}

// The candidate instead where the solution did not converge, which may end anywhere, and is more bent. Solutions of
// part of a load and minimal surfaces stay as they are: bending does not compare them.
void keep_less_bent(const Problem& problem, const Points& candidate, Solution& solution) {
    if (problem.options.equation == Equation::soap_film || solution.termination == Termination::converged) return;
    if (solution.reached_load > 0.0) return;
    if (willmore_energy(problem, solution.points) <= willmore_energy(problem, candidate)) return;
    const SurfaceState state = measured_surface(problem, candidate);
    solution.points = candidate;
    solution.mean_curvature = state.curvature.mean;
    solution.residual = largest_residual(problem, state, outer_residual(problem, state));
}

}  // namespace

bool less_bent(const Problem& problem, const Solution& a, const Solution& b) {
    return !(willmore_energy(problem, b.points) <= willmore_energy(problem, a.points));
}

Solution solve_directly(const Problem& problem, const Progress& progress) {
    Stopwatch watch;
    Workspace work{
        make_normal_operator(problem),
        make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.range(0.0, 0.05))};
    const Start start = make_start(problem, work, progress.range(0.05, 0.6));
    const double start_seconds = watch.lap();
    Solution solution = solve_equation(problem, work, start.points, progress.range(0.6, 1.0));
    for (const Points* candidate : {&start.points, &start.membrane}) keep_less_bent(problem, *candidate, solution);
    solution.boundary_normals = boundary_normals(problem, solution.points);
    solution.initial_residual = start.initial_residual;
    solution.seconds = {{"fill", start.fill_seconds},
                        {"globalisation", start_seconds - start.fill_seconds},
                        {"iteration", watch.lap()}};
    return solution;
}

Solution try_directly(const Problem& problem, const Progress& progress) {
    Problem attempt = problem;
    attempt.conduct.limits = brisk;
    return solve_directly(attempt, progress);
}

}  // namespace fairing
