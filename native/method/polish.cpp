#include "method/polish.h"

#include <algorithm>

#include "geometry/surface_fit.h"
#include "iteration/accelerated_iteration.h"

namespace fairing {

namespace {

// From the surface itself few iterations are needed; after many, it is another solution.
constexpr int most_iterations = 40;
constexpr int most_for_digits = 80;
constexpr int patience = 4;
// The last digits come unevenly: on a graded hemisphere of 5,000 vertices no step from 1e-9 D on was the shortest for
// more than four. A cap of 140° ended in vain after 31 steps with half of this patience, and is solved in 45 with it.
constexpr int patience_for_digits = 16;

int most_to(double tolerance) { return tolerance < SolverOptions{}.tolerance ? most_for_digits : most_iterations; }
int patience_to(double tolerance) { return tolerance < SolverOptions{}.tolerance ? patience_for_digits : patience; }

}  // namespace

Solution polish(const Problem& problem, Workspace& work, Solution placed, const SolvedSurface& surface, Hope hope,
                const Progress& progress) {
    Problem polishing = problem;
    polishing.options.max_iterations = std::min(most_to(problem.options.tolerance), problem.options.max_iterations);
    polishing.options.patience = std::min(patience_to(problem.options.tolerance), problem.options.patience);
    polishing.options.contracts = hope == Hope::little;
    Solution own = iterate(polishing, work, placed.points, progress);
    if (own.termination != Termination::converged || !agree(problem, own, surface)) return placed;
    own.boundary_normals = one_sided_normals(problem.patch, own.points);
    own.from_surface = true;
    own.crosses = placed.crosses;
    return flaw_of(problem, own) == Flaw::absent ? own : placed;
}

}  // namespace fairing
