#include "problem/willmore.h"

#include <Eigen/Geometry>

namespace fairing {

Points conormals(const Patch& patch, const Points& fixed_points, const Points& normals) {
    Points result = Points::Zero(3, fixed_points.cols());
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[static_cast<std::size_t>(e)][1] != none) continue;
        const auto [from, to] = patch.edge_ends[static_cast<std::size_t>(e)];
        const int a = from - patch.free_count;
        const int b = to - patch.free_count;
        const Vector3 edge = fixed_points.col(b) - fixed_points.col(a);
        const Vector3 at_a = edge.cross(Vector3(normals.col(a)));
        const Vector3 at_b = edge.cross(Vector3(normals.col(b)));
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

namespace {

// Adds −∂/∂x [Σ_k cot_k ⟨x_a − x_b, y_a − y_b⟩] with y held, and −Σ |y_i|² ∂M_i/∂x, of one triangle.
void add_triangle_gradient(const Eigen::Matrix3d& x, const Eigen::Matrix3d& y, Eigen::Matrix3d& gradient) {
    const Vector3 cross = Vector3(x.col(1) - x.col(0)).cross(Vector3(x.col(2) - x.col(0)));
    const double twice_area = cross.norm();
    if (!(twice_area > 0.0)) return;
    const Vector3 n = cross / twice_area;
    Eigen::Matrix3d area_gradient;  // of twice the area
    for (int k = 0; k < 3; ++k) area_gradient.col(k) = n.cross(Vector3(x.col((k + 2) % 3) - x.col((k + 1) % 3)));
    for (int k = 0; k < 3; ++k) {
        const int a = (k + 1) % 3;
        const int b = (k + 2) % 3;
        const Vector3 to_a = x.col(a) - x.col(k);
        const Vector3 to_b = x.col(b) - x.col(k);
        const double cotangent = to_a.dot(to_b) / twice_area;
        const Vector3 dy = y.col(a) - y.col(b);
        const double product = (to_a - to_b).dot(dy);
        gradient.col(a) -= cotangent * dy + product / twice_area * (to_b - cotangent * area_gradient.col(a));
        gradient.col(b) -= -cotangent * dy + product / twice_area * (to_a - cotangent * area_gradient.col(b));
        gradient.col(k) += product / twice_area * (to_a + to_b + cotangent * area_gradient.col(k));
    }
    gradient -= y.colwise().squaredNorm().sum() / 6.0 * area_gradient;
}

}  // namespace

Points willmore_gradient(const Patch& patch, const Stiffness& stiffness, const Points& points,
                         const Points& curvature_vectors) {
    const Points y = curvature_vectors.array().rowwise() / stiffness.mass.transpose().array();
    Points gradient = Points::Zero(3, patch.vertex_count());
    for (const auto triangle : patch.triangles.colwise()) {
        Eigen::Matrix3d corners;
        Eigen::Matrix3d values;
        for (int k = 0; k < 3; ++k) {
            corners.col(k) = points.col(triangle[k]);
            values.col(k) = y.col(triangle[k]);
        }
        Eigen::Matrix3d local = Eigen::Matrix3d::Zero();
        add_triangle_gradient(corners, values, local);
        for (int k = 0; k < 3; ++k) gradient.col(triangle[k]) += local.col(k);
    }
    return gradient.leftCols(patch.free_count);
}

}  // namespace fairing
