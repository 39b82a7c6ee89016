#include "geometry/mean_curvature.h"

#include <Eigen/Cholesky>

#include "geometry/frame.h"
#include "geometry/one_ring_buffer.h"
#include "geometry/virtual_points.h"

namespace fairing {

double CurvatureFit::rise(const Vector3& normal, const Vector3& d) const {
    const Frame frame(normal);
    const double a = frame.u.dot(d);
    const double b = frame.v.dot(d);
    return 0.5 * (x0 * a * a + x1 * a * b + x2 * b * b);
}

CurvatureFit fit_curvature(const Vector3& centre, std::span<const Vector3> points, const Vector3& normal) {
    const Frame frame(normal);
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Vector3 rhs = Vector3::Zero();
    for (const Vector3& p : points) {
        const Vector3 d = p - centre;
        const double squared = d.squaredNorm();
        const Eigen::Vector2d t(frame.u.dot(d), frame.v.dot(d));
        const double in_plane = t.squaredNorm();
        if (!(in_plane > 1e-24 * squared)) continue;
        const Vector3 row(t.x() * t.x() / in_plane, t.x() * t.y() / in_plane, t.y() * t.y() / in_plane);
        A.noalias() += row * row.transpose();
        rhs += (2.0 * normal.dot(d) / squared) * row;
    }
    A.diagonal().array() += 1e-9 * A.trace() + 1e-300;
    const Vector3 x = A.llt().solve(rhs);
    return {x[0], x[1], x[2]};
}

VectorX PatchCurvature::gaussian() const {
    return form.row(0).cwiseProduct(form.row(2)).transpose() - 0.25 * form.row(1).cwiseAbs2().transpose();
}

PatchCurvature patch_curvature(const Patch& patch, const Points& points, const FaceGeometry& faces,
                               const Points& normals) {
    const Points virtual_points = edge_virtual_points(patch, points, faces, normals);
    OneRingBuffer buffer;
    PatchCurvature curvature{VectorX(patch.vertex_count()), Points(3, patch.vertex_count())};
    for (int i = 0; i < patch.vertex_count(); ++i) {
        buffer.gather(patch, points, i);
        const auto all = buffer.with_virtual(patch, virtual_points, i);
        const CurvatureFit fit = fit_curvature(points.col(i), all, normals.col(i));
        curvature.mean[i] = fit.mean();
        curvature.form.col(i) << fit.x0, fit.x1, fit.x2;
    }
    return curvature;
}

}  // namespace fairing
