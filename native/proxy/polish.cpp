#include "proxy/polish.h"

#include <algorithm>

#include "geometry/surface_fit.h"
#include "solver/accelerated_iteration.h"
#include "solver/surface_state.h"

namespace fairing {

namespace {

// From the surface itself few iterations are needed; after many, it is another solution.
constexpr int most_iterations = 40;
constexpr int patience = 12;

// Both meshes discretise one surface. Where they differ by more than their own errors, the problem's mesh is too poor
// to carry the equation: on crowded or needle-shaped triangles a step may be small and H nonsense.
bool agree(const Problem& problem, const Solution& polished, const Solution& placed) {
    constexpr double farthest = 2e-4;        // units of D
    constexpr double curvature_share = 0.1;  // of the largest |H|, or of 1/D where that is less
    if (largest_length(polished.points - placed.points) > farthest) return false;
    const Eigen::Index count = problem.patch.free_count;
    const VectorX difference = polished.mean_curvature.head(count) - placed.mean_curvature.head(count);
    return difference.cwiseAbs().maxCoeff() <
           curvature_share * std::max(1.0, placed.mean_curvature.cwiseAbs().maxCoeff());
}

}  // namespace

Solution polish(const Problem& problem, Workspace& work, Solution placed, const Progress& progress) {
    Problem polishing = problem;
    polishing.options.max_iterations = std::min(most_iterations, problem.options.max_iterations);
    polishing.options.patience = std::min(patience, problem.options.patience);
    Solution polished = iterate(polishing, work, placed.points, progress);
    if (polished.termination != Termination::converged || !agree(problem, polished, placed)) return placed;
    polished.boundary_normals = one_sided_normals(problem.patch, polished.points);
    return polished;
}

}  // namespace fairing
