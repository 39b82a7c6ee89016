#include "detail/skin.h"

#include <Eigen/Geometry>

#include "base/limits.h"
#include "detail/low_pass.h"
#include "geometry/flips.h"
#include "geometry/surface_fit.h"
#include "problem/surface_state.h"
#include "tangential/slide.h"

namespace fairing {

namespace {

// Two passes leave 1 − (q/(1 + q))² of a wave, q = (2π l/wavelength)⁴: one half at q = 1 + √2.
double mass_factor(double wavelength) {
    const double half = 1.0 + std::numbers::sqrt2;
    return std::pow(2.0 * std::numbers::pi / wavelength, 4) / half;
}

// c of the slopes at which the old patch meets its boundary, fitted to its own side. Those prescribed for the new base
// would make detail of a crease along the boundary, which is what has to go.
Points own_conormals(const Patch& patch, const OldPatch& old, double wavelength) {
    Indices fixed(patch.vertex_count() - patch.free_count);
    std::iota(fixed.begin(), fixed.end(), patch.free_count);
    const LowPass smooth = low_pass(old.points, patch.triangles, fixed, wavelength);
    Points normals = smooth.normals;
    if (std::count(smooth.found.begin(), smooth.found.end(), 0) > 0) {
        const Points narrow = one_sided_normals(patch, old.points);
        for (int k = 0; k < static_cast<int>(fixed.size()); ++k) {
            if (!smooth.found[k]) normals.col(k) = narrow.col(k);
        }
    }
    return conormals(patch, old.boundary, normals);
}

Eigen::Matrix3d corners_of(const Patch& patch, const Points& points, int triangle) {
    return points(Eigen::all, patch.triangles.col(triangle));
}

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

double detail_wavelength(const Patch& patch, const Points& old) {
    constexpr double edges = 12.0;           // of the mean: what is longer is shape
    constexpr double share_of_patch = 0.45;  // of D: longer waves are the patch itself
    double length = 0.0;
    for (const auto& [a, b] : patch.edge_ends) length += (old.col(a) - old.col(b)).norm();
    return std::min(edges * length / patch.edge_count(), share_of_patch);
}

BaseFilter::BaseFilter(const Patch& patch, const Stiffness& stiffness, const OldPatch& old, double wavelength)
    : patch_(patch),
      stiffness_(stiffness),
      boundary_(old.boundary),
      conormals_(own_conormals(patch, old, wavelength)),
      smoothing_(patch, old.points.leftCols(patch.free_count)) {}

std::optional<Points> BaseFilter::without(const Points& surface, double wavelength, const Progress& progress) {
    const double mass = mass_factor(wavelength);
    if (factorised_for_ != wavelength) {
        factorised_for_ = 0.0;
        if (!smoothing_.update_with_mass(stiffness_, VectorX::Constant(patch_.free_count, mass), progress))
            return std::nullopt;
        factorised_for_ = wavelength;
    }
    Points base = surface;
    base.rightCols(boundary_.cols()) = boundary_;
    Points h = mixed_curvature_vectors(patch_, stiffness_, base, conormals_);
    h.array().rowwise() /= 2.0 * stiffness_.mass.transpose().array();
    const Eigen::MatrixXd first = smoothing_.solve(stiffness_.apply(patch_, h, patch_.free_count).transpose());
    const Eigen::MatrixXd left = mass * stiffness_.mass.head(patch_.free_count).asDiagonal() * first;
    base.leftCols(patch_.free_count) += (first - smoothing_.solve(left)).transpose();
    return base;
}

std::optional<Points> old_base(const Patch& patch, const Stiffness& stiffness, const OldPatch& old, double wavelength,
                               const Progress& progress) {
    return BaseFilter(patch, stiffness, old, wavelength).without(old.points, wavelength, progress);
}

std::unique_ptr<Skin> Skin::read(const Patch& patch, const OldPatch& old, double wavelength, const Progress& progress) {
    std::unique_ptr<Skin> skin(new Skin(patch, old.points));
    return skin->split(old, wavelength, progress) ? std::move(skin) : nullptr;
}

Skin::Skin(const Patch& patch, const Points& old) : patch_(patch), laplacian_(patch, old.leftCols(patch.free_count)) {}

bool Skin::split(const OldPatch& old, double wavelength, const Progress& progress) {
    faces_.update(old.points, patch_.triangles);
    Stiffness stiffness;
    stiffness.update(faces_, patch_);
    std::optional<Points> base = old_base(patch_, stiffness, old, wavelength, progress);
    if (!base || !base->allFinite() || !laplacian_.update(stiffness, progress)) return false;
    base_ = std::move(*base);
    detail_ = old.points - base_;
    return true;
}

Eigen::Matrix3d Skin::pull(int t, const Points& field) const {
    const Eigen::Matrix3d corners = corners_of(patch_, field, t);
    Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3;
        const int j = (k + 2) % 3;
        const Vector3 difference = faces_.cotangents(k, t) * (corners.col(i) - corners.col(j));
        result.col(i) += difference;
        result.col(j) -= difference;
    }
    return result;
}

// Σ cot R (d_i − d_j) at all vertices, less the share of S y that the fixed ones have.
Points Skin::sources(const Points& new_base, const Points& at_boundary) const {
    Points known = Points::Zero(3, patch_.vertex_count());
    known.rightCols(at_boundary.cols()) = at_boundary;
    std::vector<Eigen::Matrix3d> pulls(patch_.triangle_count());  // column k: at corner k
    for_ranges(patch_.triangle_count(), coarse_grain, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) {
            const Eigen::Matrix3d turn =
                turn_of_triangle(corners_of(patch_, base_, t), corners_of(patch_, new_base, t));
            pulls[t] = turn * pull(t, detail_) - pull(t, known);
        }
    });
    Points sum = Points::Zero(3, patch_.vertex_count());
    for (int t = 0; t < patch_.triangle_count(); ++t) {
        for (int k = 0; k < 3; ++k) sum.col(patch_.triangles(k, t)) += pulls[t].col(k);
    }
    return sum;
}

Points Skin::detail_on(const Points& new_base, const Points& at_boundary) const {
    const Points pulls = sources(new_base, at_boundary).leftCols(patch_.free_count);
    return laplacian_.solve(pulls.transpose()).transpose();
}

Indices Skin::turned_over(const Points& new_base, const Points& shown) const {
    FaceGeometry old_base;
    FaceGeometry below;
    FaceGeometry above;
    old_base.update(base_, patch_.triangles);
    below.update(new_base, patch_.triangles);
    above.update(shown, patch_.triangles);
    Indices result;
    for (int t = 0; t < patch_.triangle_count(); ++t) {
        const bool before = faces_.normals.col(t).dot(old_base.normals.col(t)) < 0.0;
        if (!before && above.normals.col(t).dot(below.normals.col(t)) < 0.0) result.push_back(t);
    }
    return result;
}

Eigen::Matrix3d turn_of_triangle(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
    const Vector3 first_from = from.col(1) - from.col(0);
    const Vector3 second_from = from.col(2) - from.col(0);
    const Vector3 first_to = to.col(1) - to.col(0);
    const Vector3 second_to = to.col(2) - to.col(0);
    const Eigen::Matrix3d axes_from = axes_of(first_from, second_from);
    const Eigen::Matrix3d axes_to = axes_of(first_to, second_to);
    if (axes_from.isZero(0.0) || axes_to.isZero(0.0)) return Eigen::Matrix3d::Identity();
    const Eigen::Matrix2d map = flat(axes_to, first_to, second_to) * flat(axes_from, first_from, second_from).inverse();
    // The angle of the polar rotation of a plane map with positive determinant.
    const double angle = std::atan2(map(1, 0) - map(0, 1), map(0, 0) + map(1, 1));
    Eigen::Matrix3d within = Eigen::Matrix3d::Identity();
    within.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(angle).toRotationMatrix();
    return axes_to * within * axes_from.transpose();
}

Points relaid(const Problem& problem, const Points& points, const Points& base, const Progress& progress) {
    const Patch& patch = problem.patch;
    Problem conformal = problem;
    conformal.weights = conformal_weights(patch, base);
    const auto tangential = make_tangential_step(patch, conformal.weights, problem.fixed_points, progress);
    Points slid = points;
    const Points normals = measured_surface(problem, points).normals;
    slide(conformal, *tangential, normals, shape_operators(conformal.patch, slid, normals), most_iterations, slid);
    const std::size_t usual = flipped_triangles(patch, points).size() + flipped_triangles(patch, base).size();
    const bool worse = !slid.allFinite() || flipped_triangles(patch, slid).size() > usual;
    return worse ? points : slid;
}

}  // namespace fairing
