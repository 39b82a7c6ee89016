#include "paper/vertex_update.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "geometry/mean_curvature.h"

namespace fairing {

void curvature_weights(const Vector3& centre, std::span<const Vector3> around, const Vector3& normal,
                       std::span<double> weights) {
    const Frame frame(normal);
    const auto row = [&](const Vector3& p) -> Vector3 {
        const Vector3 d = p - centre;
        const double x = frame.u.dot(d);
        const double y = frame.v.dot(d);
        const double in_plane = x * x + y * y;
        if (!(in_plane > no_direction * d.squaredNorm())) return Vector3::Zero();
        return Vector3(x * x, x * y, y * y) / in_plane;
    };
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    for (const Vector3& p : around) matrix += row(p) * row(p).transpose();
    const double slight = 1e-9 * matrix.trace() + 1e-300;  // as CurvatureRows
    matrix.diagonal().array() += slight;
    const Vector3 mean = matrix.inverse() * Vector3(0.5, 0.0, 0.5);
    for (std::size_t k = 0; k < around.size(); ++k) weights[k] = mean.dot(row(around[k]));
}

Vector3 updated_position(const Vector3& present, std::span<const Vector3> around, const VertexTarget& target) {
    const Vector3& n = target.normal;
    const Vector3 start = target.mean - n.dot(target.mean - present) * n;
    double mean = 0.0;
    double slope = 0.0;
    double squares = 0.0;
    for (std::size_t k = 0; k < around.size(); ++k) {
        const Vector3 d = around[k] - start;
        const double squared = std::max(d.squaredNorm(), 1e-300);
        mean += 2.0 * target.weights[k] / squared * n.dot(d);
        slope -= 2.0 * target.weights[k] / squared;
        squares += squared;
    }
    if (!(std::abs(slope) > 0.0)) return start;
    const double limit = std::sqrt(squares / static_cast<double>(around.size()));
    const double t = std::clamp((target.curvature - mean) / slope, -limit, limit);
    return std::isfinite(t) ? Vector3(start + target.damping * t * n) : present;
}

}  // namespace fairing
