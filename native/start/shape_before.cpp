#include "start/shape_before.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/flips.h"
#include "problem/willmore.h"
#include "start/clamped_fill.h"
#include "start/several_outlines.h"

namespace fairing {

namespace {

bool is_usable(const Problem& problem) {
    constexpr double most_turned = 0.05;  // of the triangles
    const Patch& patch = problem.patch;
    const Points& before = *problem.before;
    if (before.cols() != patch.vertex_count() || !before.allFinite()) return false;
    if (!(total_area(before, patch.triangles) > 1e-9)) return false;
    const auto turned = static_cast<double>(flipped_triangles(patch, before).size());
    return turned <= most_turned * patch.triangle_count();
}

// The shape before over the outline of today.
std::optional<Points> over_outline(const Problem& problem, const Progress& progress) {
    const Patch& patch = problem.patch;
    const Points& before = *problem.before;
    Points moves = Points::Zero(3, patch.vertex_count());
    moves.rightCols(problem.fixed_points.cols()) = problem.fixed_points - before.rightCols(problem.fixed_points.cols());
    if (moves.isZero(0.0)) return before;
    const auto everywhere = harmonic_between(patch, std::move(moves), progress);
    return everywhere ? std::optional<Points>(before + *everywhere) : std::nullopt;
}

// Of ∫ |Δx|² at the shape itself, between the tangent planes wanted.
Points pull_of(const Problem& problem, const Points& points, const Stiffness& stiffness) {
    const Patch& patch = problem.patch;
    Points bending = -stiffness.apply(patch, points, patch.vertex_count());
    const Points own = -bending.rightCols(problem.fixed_points.cols());
    const Points given = 2.0 * conormals(patch, problem.fixed_points, problem.fixed_normals);
    const Eigen::RowVectorXd trust = trust_in_slopes(problem).transpose();
    bending.rightCols(own.cols()) += own + ((given - own).array().rowwise() * trust.array()).matrix();
    bending.array().rowwise() /= 4.0 * stiffness.mass.transpose().array();
    return stiffness.apply(patch, bending, patch.free_count);
}

}  // namespace

Stiffness bounded_stiffness(const Patch& patch, const Points& points) {
    constexpr double largest_weight = 10.0;  // 2 / √3 between equilateral triangles
    constexpr double least_mass = 1e-3;      // of the mean
    FaceGeometry faces;
    faces.update(points, patch.triangles);
    Stiffness stiffness;
    stiffness.update(faces, patch);
    stiffness.weights = stiffness.weights.cwiseMax(-largest_weight).cwiseMin(largest_weight);
    stiffness.mass = stiffness.mass.cwiseMax(least_mass * stiffness.mass.mean());
    return stiffness;
}

std::optional<Points> shape_before(const Problem& problem, const Progress& progress) {
    return is_usable(problem) ? over_outline(problem, progress) : std::nullopt;
}

std::optional<ShapeBefore> ShapeBefore::of(const Problem& problem, const Progress& progress) {
    auto points = shape_before(problem, progress);
    if (!points) return std::nullopt;
    return ShapeBefore(problem, std::move(*points));
}

ShapeBefore::ShapeBefore(const Problem& problem, Points points)
    : problem_(problem),
      points_(std::move(points)),
      stiffness_(bounded_stiffness(problem.patch, points_)),
      pull_(pull_of(problem, points_, stiffness_)),
      operator_(problem.patch, points_.leftCols(problem.patch.free_count)) {}

std::optional<Points> ShapeBefore::smoothed(const VectorX& wavelengths, const Progress& progress) {
    const int count = problem_.patch.free_count;
    const VectorX factors = (2.0 * std::numbers::pi / wavelengths.head(count).array()).pow(4);
    if (!operator_.update_with_mass(stiffness_, factors, progress)) return std::nullopt;
    Points result = points_;
    result.leftCols(count) += operator_.solve(pull_.transpose()).transpose();
    return result;
}

}  // namespace fairing
