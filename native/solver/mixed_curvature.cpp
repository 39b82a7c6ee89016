#include "solver/mixed_curvature.h"

#include <Eigen/Geometry>

namespace fairing {

Points conormals(const Patch& patch, const Points& fixed_points, const Points& fixed_normals) {
    Points result = Points::Zero(3, fixed_points.cols());
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[static_cast<std::size_t>(e)][1] != none) continue;
        const auto [from, to] = patch.edge_ends[static_cast<std::size_t>(e)];
        const int a = from - patch.free_count;
        const int b = to - patch.free_count;
        const Vector3 edge = fixed_points.col(b) - fixed_points.col(a);
        const Vector3 at_a = edge.cross(Vector3(fixed_normals.col(a)));
        const Vector3 at_b = edge.cross(Vector3(fixed_normals.col(b)));
        result.col(a) += at_a / 3.0 + at_b / 6.0;
        result.col(b) += at_b / 3.0 + at_a / 6.0;
    }
    return result;
}

Points mixed_curvature_vectors(const Patch& patch, const Stiffness& stiffness, const Points& points,
                               const Points& conormals) {
    Points h = -0.5 * stiffness.apply(patch, points, patch.vertex_count());
    h.rightCols(conormals.cols()) += conormals;
    return h;
}

VectorX mixed_mean_curvature(const Points& curvature_vectors, const Stiffness& stiffness, const Points& normals) {
    return curvature_vectors.cwiseProduct(normals).colwise().sum().transpose().cwiseQuotient(2.0 * stiffness.mass);
}

double willmore_energy(const Points& curvature_vectors, const Stiffness& stiffness) {
    return (curvature_vectors.colwise().squaredNorm().transpose().cwiseQuotient(stiffness.mass)).sum();
}

}  // namespace fairing
