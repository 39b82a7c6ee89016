#include "solver/surface_state.h"

#include <cmath>

#include "geometry/mean_curvature.h"
#include "geometry/surface_fit.h"

namespace fairing {

void SurfaceState::measure_faces(const Patch& patch) {
    faces.update(points, patch.triangles);
    stiffness.update(faces, patch);
}

void SurfaceState::measure_curvature(const Problem& problem) {
    // Without prescribed normals (G0) the outline's come from the surface itself.
    const Points boundary = problem.options.equation == Equation::minimal ? one_sided_normals(problem.patch, points)
                                                                          : problem.fixed_normals;
    normals = vertex_normals(problem.patch, points, faces, boundary, problem.options.normals);
    mean_curvature = patch_mean_curvature(problem.patch, points, faces, normals);
}

double largest_length(const Points& field) { return std::sqrt(field.colwise().squaredNorm().maxCoeff()); }

VectorX outer_residual(const Problem& problem, const SurfaceState& state) {
    const int count = problem.patch.free_count;
    if (problem.options.equation == Equation::minimal) {
        return 4.0 * state.stiffness.mass.head(count).cwiseProduct(state.mean_curvature.head(count));
    }
    const Eigen::RowVectorXd H = state.mean_curvature.transpose();
    return state.stiffness.apply(problem.patch, H, count).transpose();
}

double largest_residual(const Problem& problem, const SurfaceState& state, const VectorX& residual) {
    const double factor = problem.options.equation == Equation::minimal ? 4.0 : 2.0;
    return residual.cwiseAbs().cwiseQuotient(factor * state.stiffness.mass.head(residual.size())).maxCoeff();
}

}  // namespace fairing
