#include "detail/old_base.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "detail/low_pass.h"
#include "geometry/surface_fit.h"
#include "problem/willmore.h"

namespace fairing {

namespace {

// Two passes leave 1 − (q/(1 + q))² of a wave, q = (2π l/wavelength)⁴: one half at q = 1 + √2.
double mass_factor(double wavelength) {
    const double half = 1.0 + std::numbers::sqrt2;
    return std::pow(2.0 * std::numbers::pi / wavelength, 4) / half;
}

// c of the slopes at which the old patch meets its outline, fitted to its own side. Those prescribed for the new base
// would make detail of a crease along the outline, which is what has to go.
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
    return conormals(patch, old.outline, normals);
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
      outline_(old.outline),
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
    base.rightCols(outline_.cols()) = outline_;
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

}  // namespace fairing
