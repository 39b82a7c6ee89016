#include "start/best_fill.h"

#include <limits>

#include "problem/surface_state.h"
#include "problem/willmore.h"
#include "start/clamped_fill.h"

namespace fairing {

Points best_fill(const Problem& problem, Workspace& work, const Progress& progress) {
    const Patch& patch = problem.patch;
    const Points boundary = conormals(patch, problem.fixed_points, problem.fixed_normals);
    const Fill fill = clamped_fill(patch, problem.fixed_points, boundary, *work.normal, progress);
    Points points(3, patch.vertex_count());
    points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    Points best;
    double least = std::numeric_limits<double>::infinity();
    // Bulges of the linear fill: a strongly curved surface needs more than the linear theory's 1.
    for (const double sigma : {1.0, 1.5, 2.2, 3.2, 4.5}) {
        points.leftCols(patch.free_count) = fill.flat + sigma * fill.bulge;
        const double energy = willmore_energy(problem, points);
        if (energy < least) {
            least = energy;
            best = points;
        }
    }
    return best;
}

}  // namespace fairing
