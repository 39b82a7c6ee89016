#include "paper/curvature_line.h"

#include <Eigen/LU>

#include "geometry/frame.h"

namespace fairing {

CurvatureLine curvature_line(const Vector3& centre, std::span<const Vector3> points, const Vector3& normal) {
    const Frame frame(normal);
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Vector3 curvatures = Vector3::Zero();
    Vector3 slopes = Vector3::Zero();
    for (const Vector3& p : points) {
        const Vector3 d = p - centre;
        const double squared = d.squaredNorm();
        const double x = frame.u.dot(d);
        const double y = frame.v.dot(d);
        const double in_plane = x * x + y * y;
        if (!(in_plane > 1e-24 * squared)) continue;
        const Vector3 row = Vector3(x * x, x * y, y * y) / in_plane;
        A.noalias() += row * row.transpose();
        curvatures += (2.0 * normal.dot(d) / squared) * row;
        slopes -= (2.0 / squared) * row;
    }
    A.diagonal().array() += 1e-9 * A.trace() + 1e-300;
    const Eigen::Matrix3d inverse = A.inverse();  // 3 × 3: by cofactors, as the paper suggests (eq. 11)
    const Vector3 at = inverse * curvatures;
    const Vector3 slope = inverse * slopes;
    return {{at[0], at[1], at[2]}, {slope[0], slope[1], slope[2]}};
}

}  // namespace fairing
