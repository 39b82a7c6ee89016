#include "method/direct.h"

#include "accept/accept.h"
#include "base/stopwatch.h"
#include "geometry/neighbourhood.h"
#include "geometry/surface_fit.h"
#include "iteration/continuation.h"
#include "method/solve.h"
#include "operators/normal_operator.h"
#include "pins/led_pins.h"
#include "pins/spread_pins.h"
#include "placement/relax.h"
#include "problem/surface_state.h"
#include "start/clamped_fill.h"
#include "start/globalisation.h"
#include "start/loft.h"
#include "start/quick_surface.h"

namespace fairing {

namespace {

double residual_of(const Problem& problem, const Points& points) {
    const SurfaceState state = measured_surface(problem, points);
    return largest_residual(problem, state, outer_residual(problem, state));
}

// The vertices of a surface, projected onto it by their inner fairness.
Points relaxed(const Problem& problem, const Workspace& work, const Points& points) {
    const SurfaceState state = measured_surface(problem, points);
    const TargetSurface target(problem.patch, points, state.normals);
    Placement placement = at_vertices(problem, target, points);
    relax(*work.tangential, target, placement);
    return placement.points;
}

// Normals of a surface that is only a start: they have to tell no more than whether it meets its boundary from behind,
// and fits take a quarter of its time.
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

// The membrane depends on the boundary's positions alone; the normals come in with the Willmore descent.
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
        start.points = relaxed(problem, work, *along_normals);
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

Solution with_pins(Solution solution, Pins pins) {
    solution.pins = pins;
    return solution;
}

bool is_of_fourth_order(const Problem& problem) {
    return problem.options.equation != Equation::soap_film && problem.options.equation != Equation::least_variation;
}

bool are_close(const Problem& problem, const Indices& pins, double distance) {
    for (std::size_t k = 0; k < pins.size(); ++k) {
        for (std::size_t l = 0; l < k; ++l) {
            if ((problem.fixed_points.col(pins[k]) - problem.fixed_points.col(pins[l])).norm() < distance) return true;
        }
    }
    return false;
}

Solution judged(const Problem& problem, Solution found) {
    found.from_surface = true;
    found.pins = Pins::spread;
    found.flaw = flaw_of(problem, found);
    return found;
}

Solution spread_from(const Problem& problem, double radius, const Points& start, const Progress& progress) {
    Solution found = spread_pins(problem, radius, start, progress);
    found.boundary_normals = one_sided_normals(problem.patch, found.points);
    return judged(problem, std::move(found));
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

Indices pins_to_spread(const Problem& problem) {
    Indices pins = isolated_pins(problem.patch);
    if (!is_of_fourth_order(problem) || static_cast<Eigen::Index>(pins.size()) == problem.fixed_points.cols())
        return {};
    return pins;
}

std::optional<Solution> lift_pins(const Problem& problem, double radius, const Progress& progress) {
    const Stopwatch watch;
    const Released free = released(problem.patch, isolated_pins(problem.patch));
    const Solution without = solve_equation_alone(on_released(problem, free), progress.range(0.0, 0.5));
    if (end_of(without) != Termination::converged) return std::nullopt;
    const Points start = without.points(Eigen::all, free.to);
    Solution found = spread_from(problem, radius, start, progress.range(0.5, 0.6));
    if (found.flaw != Flaw::absent) {
        auto led = lead_pins(problem, radius, start, progress.range(0.6, 1.0));
        if (!led) return std::nullopt;
        found = judged(problem, std::move(*led));
        if (found.flaw != Flaw::absent) return std::nullopt;
    }
    found.initial_residual = without.initial_residual;
    found.seconds = without.seconds;
    found.strategies = {{"lifted pins", watch.seconds()}};
    return found;
}

Solution with_spread_pins(const Problem& problem, double radius, Solution sharp, const Progress& progress) {
    const bool is_asked = radius > 0.0 && is_of_fourth_order(problem) && !stands_in(sharp.provenance);
    if (!is_asked || sharp.pins == Pins::spread || isolated_pins(problem.patch).empty()) return sharp;
    if (end_of(sharp) != Termination::converged) return with_pins(std::move(sharp), Pins::no_surface);
    const Indices pins = pins_to_spread(problem);
    if (pins.empty()) return with_pins(std::move(sharp), Pins::no_boundary);
    const Stopwatch watch;
    std::optional<Solution> found = spread_from(problem, radius, sharp.points, progress);
    if (found->flaw != Flaw::absent) {
        const bool is_tried = sharp.pins == Pins::not_found;
        found = is_tried ? std::nullopt : lift_pins(problem, radius, progress);
    }
    const double seconds = watch.seconds();
    sharp.seconds["pins"] = seconds;
    sharp.strategies.push_back({"pins", seconds});
    if (!found) {
        const bool close = are_close(problem, pins, 2.0 * radius);
        return with_pins(std::move(sharp), close ? Pins::too_close : Pins::not_found);
    }
    found->initial_residual = sharp.initial_residual;
    found->levels = sharp.levels;
    found->seconds = sharp.seconds;
    found->strategies = sharp.strategies;
    found->uniform_weights = sharp.uniform_weights;
    return std::move(*found);
}

}  // namespace fairing
