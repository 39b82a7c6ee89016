#include "fill/ball_start.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "fairness/harmonic_values.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double widest_flat = 115.0 * degree;  // half-angle up to which a flat start grows into the surface quickly
constexpr double least_turn = 1e-3;             // of the normals along the boundary, below which there is no ball

struct Ball {
    Vector3 centre;
    double radius;  // negative where the normals point inwards
};

// The least squares of p − centre − radius · n.
std::optional<Ball> fitted_ball(const Points& points, const Points& normals) {
    const Vector3 middle = points.rowwise().mean();
    const Vector3 mean = normals.rowwise().mean();
    const Points turned = normals.colwise() - mean;
    if (!(turned.squaredNorm() > least_turn * static_cast<double>(normals.cols()))) return std::nullopt;
    const double radius = (points.colwise() - middle).cwiseProduct(turned).sum() / turned.squaredNorm();
    return Ball{middle - radius * mean, radius};
}

// Where the surface is, seen from the centre: it lies on the left of the loop.
Vector3 apex_direction(const Points& points, const Indices& loop, const Ball& ball) {
    Vector3 area = Vector3::Zero();
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vector3 here = points.col(loop[k]) - ball.centre;
        area += here.cross(Vector3(points.col(loop[(k + 1) % loop.size()]) - ball.centre));
    }
    return std::copysign(1.0, ball.radius) * direction(area);
}

// Angle from the apex and distance from the centre, and back from these. The angle keeps its direction around
// the apex: what lies between two places has its place between theirs.
class Spread {
public:
    Spread(const Vector3& centre, const Vector3& apex) : centre_(centre) {
        axes_.col(2) = apex;
        axes_.col(0) = apex.unitOrthogonal();
        axes_.col(1) = apex.cross(axes_.col(0));
    }

    [[nodiscard]] Vector3 out(const Vector3& point) const {
        const Vector3 local = axes_.transpose() * (point - centre_);
        const double across = local.head<2>().norm();
        const double angle = std::atan2(across, local.z());
        const double scale = across > 0.0 ? angle / across : 0.0;
        return {scale * local.x(), scale * local.y(), local.norm()};
    }

    [[nodiscard]] Vector3 back(const Vector3& spread) const {
        const double angle = spread.head<2>().norm();
        const double sine = angle > 0.0 ? std::sin(angle) / angle : 1.0;
        const Vector3 local(sine * spread.x(), sine * spread.y(), std::cos(angle));
        return centre_ + spread.z() * (axes_ * local);
    }

private:
    Vector3 centre_;
    Eigen::Matrix3d axes_;
};

}  // namespace

std::optional<Points> ball_start(const Patch& patch, const Points& flat, const Points& normals) {
    const std::vector<Indices> loops = patch.loops();
    if (loops.size() != 1) return std::nullopt;
    const Points boundary = flat.rightCols(normals.cols());
    const std::optional<Ball> ball = fitted_ball(boundary, normals);
    if (!ball) return std::nullopt;
    const Spread spread(ball->centre, apex_direction(flat, loops.front(), *ball));
    Eigen::MatrixXd places(boundary.cols(), 3);
    double angles = 0.0;
    for (Eigen::Index k = 0; k < boundary.cols(); ++k) {
        places.row(k) = spread.out(boundary.col(k)).transpose();
        angles += places.row(k).head<2>().norm();
    }
    if (!(angles > widest_flat * static_cast<double>(boundary.cols()))) return std::nullopt;
    const std::optional<Eigen::MatrixXd> inside = harmonic_values(patch, flat, places);
    if (!inside) return std::nullopt;
    Points points = flat;
    for (int v = 0; v < patch.free_count; ++v) points.col(v) = spread.back(inside->row(v).transpose());
    return points;
}

}  // namespace fairing
