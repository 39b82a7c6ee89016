#include "detail/turn.h"

#include <cmath>

#include <Eigen/Geometry>

namespace fairing {

namespace {

// Columns: the direction of the first side, across it within the triangle, the normal. Zero without area.
Eigen::Matrix3d axes_of(const Vector3& first, const Vector3& second) {
    const Vector3 normal = first.cross(second);
    const double area = normal.norm();
    Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
    if (!(area > 1e-12 * first.squaredNorm()) || !(area > 1e-12 * second.squaredNorm())) return axes;
    axes.col(0) = first.normalized();
    axes.col(2) = normal / area;
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
}

// A triangle's sides in its own axes; the first one lies on the first axis.
Eigen::Matrix2d flat(const Eigen::Matrix3d& axes, const Vector3& first, const Vector3& second) {
    Eigen::Matrix2d sides;
    sides << first.norm(), axes.col(0).dot(second), 0.0, axes.col(1).dot(second);
    return sides;
}

}  // namespace

Eigen::Matrix3d turn_of_triangle(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
    const Vector3 first_from = from.col(1) - from.col(0);
    const Vector3 second_from = from.col(2) - from.col(0);
    const Vector3 first_to = to.col(1) - to.col(0);
    const Vector3 second_to = to.col(2) - to.col(0);
    const Eigen::Matrix3d axes_from = axes_of(first_from, second_from);
    const Eigen::Matrix3d axes_to = axes_of(first_to, second_to);
    if (axes_from.isZero(0.0) || axes_to.isZero(0.0)) return Eigen::Matrix3d::Identity();
    const Eigen::Matrix2d map = flat(axes_to, first_to, second_to) * flat(axes_from, first_from, second_from).inverse();
    // Of a plane map with positive determinant the polar rotation turns by this angle.
    const double angle = std::atan2(map(1, 0) - map(0, 1), map(0, 0) + map(1, 1));
    Eigen::Matrix3d within = Eigen::Matrix3d::Identity();
    within.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(angle).toRotationMatrix();
    return axes_to * within * axes_from.transpose();
}

}  // namespace fairing
