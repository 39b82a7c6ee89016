#include "variation/lift.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "variation/element.h"

namespace fairing {

namespace {

constexpr int most_steps = 4;             // of Newton's method, from a foot on the flat triangle
constexpr double at_vertex = 1.0 - 1e-9;  // barycentric weight
constexpr double farthest = 0.1;          // of an edge, from the curved triangle

// One Gauss–Newton step for the motion of a sample.
Motion fitted_motion(const SurfaceSample& sample, const Sheet& sheet, const Stencil& stencil, const LocalCubic& cubic) {
    const Frame frame(sample.normal);
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Vector3 rhs = Vector3::Zero();
    for (int vertex : stencil) {
        if (vertex == none) continue;
        const Vector3 along = sheet.points.col(vertex) - sample.point;
        const double length = along.norm();
        const Vector3 sum = sheet.normals.col(vertex) + sample.normal;
        const double residual = sum.dot(along) - length * length * length / 6.0 * cubic.along(along);
        const Vector3 row(-sum.dot(sample.normal), frame.u.dot(along), frame.v.dot(along));
        const double weight = std::pow(length, -4);  // of what is left of the next order, squared
        matrix += weight * row * row.transpose();
        rhs -= weight * residual * row;
    }
    return matrix.ldlt().solve(rhs);
}

}  // namespace

Lift::Lift(const Patch& patch, const Sheet& sheet) : sheet_(sheet), stencils_(stencils(patch)) {}

SurfaceSample Lift::sample(const TargetSurface& target, const SurfacePoint& where) const {
    const Stencil& stencil = stencils_[where.triangle];
    for (int k = 0; k < 3; ++k) {
        const int corner = stencil[k];
        if (where.weights[k] > at_vertex) return {sheet_.points.col(corner), sheet_.normals.col(corner)};
    }
    const SurfaceSample first{target.position(where), target.normal(where)};
    const LocalCubic cubic = local_cubic(sheet_, stencil);
    SurfaceSample best = first;
    for (int step = 0; step < most_steps; ++step) {
        const Motion motion = fitted_motion(best, sheet_, stencil, cubic);
        if (!motion.allFinite()) return first;
        const Frame frame(best.normal);
        best.point += motion[0] * best.normal;
        best.normal = (best.normal + motion[1] * frame.u + motion[2] * frame.v).normalized();
    }
    const double edge = (sheet_.points.col(stencil[1]) - sheet_.points.col(stencil[0])).norm();
    return (best.point - first.point).norm() < farthest * edge ? best : first;
}

}  // namespace fairing
