#include "method/least_bent.h"

#include "problem/surface_state.h"

namespace fairing {

bool less_bent(const Problem& problem, const Solution& a, const Solution& b) {
    return !(willmore_energy(problem, b.points) <= willmore_energy(problem, a.points));
}

void keep_less_bent(const Problem& problem, const Points& candidate, Solution& solution) {
    if (problem.options.equation == Equation::minimal || solution.termination == Termination::converged) return;
    if (solution.reached_load > 0.0) return;
    if (willmore_energy(problem, solution.points) <= willmore_energy(problem, candidate)) return;
    const SurfaceState state = measured_surface(problem, candidate);
    solution.points = candidate;
    solution.mean_curvature = state.curvature.mean;
    solution.residual = largest_residual(problem, state, outer_residual(problem, state));
}

}  // namespace fairing
