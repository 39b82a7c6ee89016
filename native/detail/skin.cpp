#include "detail/skin.h"

#include "detail/turn.h"

namespace fairing {

namespace {

Eigen::Matrix3d corners_of(const Patch& patch, const Points& points, int triangle) {
    return points(Eigen::all, patch.triangles.col(triangle));
}

}  // namespace

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
Points Skin::sources(const Points& new_base, const Points& at_outline) const {
    Points known = Points::Zero(3, patch_.vertex_count());
    known.rightCols(at_outline.cols()) = at_outline;
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

Points Skin::detail_on(const Points& new_base, const Points& at_outline) const {
    const Points pulls = sources(new_base, at_outline).leftCols(patch_.free_count);
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

}  // namespace fairing
