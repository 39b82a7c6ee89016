#include "reuse/outline_move.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr double farthest_move = 0.05;      // units of D
constexpr double cos_of_widest_turn = 0.7;  // 45°

// Of directions and places. Both are centred.
Eigen::Matrix3d best_rotation(const Points& from, const Points& to) {
    const Eigen::Matrix3d covariance = to * from.transpose();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d U = svd.matrixU();
    if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) = -U.col(2);
    return U * svd.matrixV().transpose();
}

// Fixed points, and normals with a small weight: they decide where the points lie on a line.
Points placed_and_turned(const Points& points, const Points& normals) {
    constexpr double weight = 1e-2;  // beside places
    Points both(3, points.cols() + normals.cols());
    both << points, weight * normals;
    return both;
}

bool turned_too_far(const Points& from, const Points& to) {
    for (Eigen::Index k = 0; k < from.cols(); ++k) {
        if (from.col(k).dot(to.col(k)) < cos_of_widest_turn * from.col(k).squaredNorm()) return true;
    }
    return false;
}

}  // namespace

Outline outline_of(const Problem& problem) {
    const Patch& patch = problem.patch;
    Outline result{problem.fixed_points, problem.fixed_normals};
    for (Eigen::Index k = 0; k < result.normals.cols(); ++k) {
        if (patch.pin[patch.free_count + static_cast<int>(k)]) result.normals.col(k).setZero();
    }
    return result;
}

std::optional<Eigen::Matrix3d> small_rotation(const Outline& last, const Outline& present) {
    const Eigen::Matrix3d rotation =
        best_rotation(placed_and_turned(last.points, last.normals), placed_and_turned(present.points, present.normals));
    if (!(largest_length(present.points - rotation * last.points) <= farthest_move)) return std::nullopt;
    if (turned_too_far(rotation * last.normals, present.normals)) return std::nullopt;
    return rotation;
}

}  // namespace fairing
