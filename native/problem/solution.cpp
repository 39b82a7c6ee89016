#include "problem/solution.h"

#include "geometry/surface_fit.h"

namespace fairing {

Solution solution_at(const Problem& problem, const Points& points, Provenance provenance) {
    Solution solution;
    solution.points = points;
    solution.termination = Termination::converged;
    solution.boundary_normals = one_sided_normals(problem.patch, points);
    solution.iterations = 1;
    solution.provenance = provenance;
    return solution;
}

}  // namespace fairing
