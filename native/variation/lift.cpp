#include "variation/lift.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "variation/element.h"

namespace fairing {

namespace {

constexpr int most_steps = 4;
constexpr double at_vertex = 1.0 - 1e-9;  // barycentric weight

// Rows of one Gauss–Newton step for the motion of a sample.
struct Fit {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Vector3 rhs = Vector3::Zero();

    void add(const Vector3& row, double residual, double weight) {
        matrix += weight * row * row.transpose();
        rhs -= weight * residual * row;
    }
};

}  // namespace

Lift::Lift(const Patch& patch, const Sheet& sheet) : sheet_(sheet), stencils_(stencils(patch)) {}

SurfaceSample Lift::sample(const TargetSurface& target, const SurfacePoint& where) const {
    const Stencil& stencil = stencils_[at(where.triangle)];
    for (int k = 0; k < 3; ++k) {
        const int corner = stencil[at(k)];
        if (where.weights[k] > at_vertex) return {sheet_.points.col(corner), sheet_.normals.col(corner)};
    }
    SurfaceSample first{target.position(where), target.normal(where)};
    SurfaceSample best = first;
    const LocalCubic cubic = local_cubic(sheet_, stencil);
    for (int step = 0; step < most_steps; ++step) {
        const Frame frame(best.normal);
        Fit fit;
        for (int vertex : stencil) {
            if (vertex == none) continue;
            const Vector3 along = sheet_.points.col(vertex) - best.point;
            const double length = along.norm();
            const Vector3 sum = sheet_.normals.col(vertex) + best.normal;
            const double residual = sum.dot(along) - length * length * length / 6.0 * cubic.along(along);
            fit.add({-sum.dot(best.normal), frame.u.dot(along), frame.v.dot(along)}, residual,
                    1.0 / std::pow(length, 4));
        }
        const Vector3 motion = fit.matrix.ldlt().solve(fit.rhs);
        if (!motion.allFinite()) return first;
        best.point += motion[0] * best.normal;
        best.normal = (best.normal + motion[1] * frame.u + motion[2] * frame.v).normalized();
    }
    const double reach = (sheet_.points.col(stencil[1]) - sheet_.points.col(stencil[0])).norm();
    return (best.point - first.point).norm() < 0.1 * reach ? best : first;
}

}  // namespace fairing
