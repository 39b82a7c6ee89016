#include "continuity/tension.h"

#include "accept/accept.h"
#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "iteration/accelerated_iteration.h"
#include "iteration/continuation.h"
#include "operators/tension_weight.h"
#include "operators/workspace.h"
#include "pins/spread_pins.h"

namespace fairing {

namespace {

Solution with_tension(Solution tangent, Tension tension) {
    tangent.tension = tension;
    return tangent;
}

// The whole tension at once, or in steps of its logarithm where that is too much: of 300 patches with tensions from .1
// to 10 twenty have no surface so, seventy without steps.
std::optional<Solution> in_steps(const Problem& problem, const Points& start, const Progress& progress) {
    const Points layout = start.leftCols(problem.patch.free_count);
    Workspace work{make_normal_operator(problem, layout, Solves::few),
                   make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())};
    Problem stage = problem;
    stage.conduct.limits = nearby;
    Points points = start;
    double share = 0.0;
    for (double increment = 1.0; increment >= smallest_increment;) {
        const double wanted = std::min(1.0, share + increment);
        const double tolerance = problem.options.tolerance;
        stage.options.tolerance = wanted < 1.0 ? std::max(tolerance, start_tolerance) : tolerance;
        work.tension = std::make_unique<TensionWeight>(stage, wanted, layout);
        Solution solution = iterate(stage, work, points, progress.range(share, wanted));
        if (solution.termination != Termination::converged) {
            increment *= 0.5;
            continue;
        }
        if (wanted >= 1.0) return solution;
        points = std::move(solution.points);
        share = wanted;
    }
    return std::nullopt;
}

// What holds for the surface that replaces the tangent join.
void inherit(Solution& found, Solution tangent) {
    found.initial_residual = tangent.initial_residual;
    found.levels = std::move(tangent.levels);
    found.seconds = std::move(tangent.seconds);
    found.ways = std::move(tangent.ways);
    found.provenance = tangent.provenance;
    found.tension = Tension::met;
}

}  // namespace

Solution tensed(const Problem& problem, Solution tangent, const Progress& progress) {
    if (problem.options.equation != Equation::harmonic)
        return with_tension(std::move(tangent), Tension::other_equation);
    if (!isolated_pins(problem.patch).empty()) return with_tension(std::move(tangent), Tension::lone_pins);
    if (tangent.flaw != Flaw::absent || tangent.uniform_weights || stands_in(tangent.provenance))
        return with_tension(std::move(tangent), Tension::no_tangent_join);
    if (!tangent.polished) return with_tension(std::move(tangent), Tension::other_mesh);
    const Stopwatch watch;
    std::optional<Solution> found = in_steps(problem, tangent.points, progress);
    const double seconds = watch.seconds();
    tangent.seconds["tension"] = seconds;
    tangent.ways.push_back({"tension", seconds});
    if (found) {
        found->boundary_normals = one_sided_normals(problem.patch, found->points);
        found->flaw = flaw_of(problem, *found);
    }
    if (!found || found->flaw != Flaw::absent) return with_tension(std::move(tangent), Tension::not_found);
    inherit(*found, std::move(tangent));
    return std::move(*found);
}

}  // namespace fairing
