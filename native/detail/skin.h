// The detail of an old patch, put back on the surface that replaces it.
#pragma once

#include "base/progress.h"
#include "base/types.h"
#include "operators/biharmonic_operator.h"
#include "operators/normal_operator.h"
#include "problem/problem.h"

namespace fairing {

// The old patch without its detail, that is without what is shorter than a wavelength.
struct OldPatch {
    const Points& points;    // 3 × local vertices, D = 1
    const Points& boundary;  // 3 × fixed vertices: where the base meets its boundary
};

// Twelve mean edges of the old patch (3 × local vertices, D = 1), but 0.45 D at most: a patch of a few edges has no
// detail.
double detail_wavelength(const Patch& patch, const Points& old);

// Removes what is shorter than a wavelength, repeatedly, from surfaces of one patch. S and M belong to the old patch x;
// c holds the low-pass slopes at which x itself meets its boundary. Refers to the patch and the stiffness.
class BaseFilter {
public:
    // `stiffness`: of `old`; `wavelength`: of the slopes at the boundary.
    BaseFilter(const Patch& patch, const Stiffness& stiffness, const OldPatch& old, double wavelength);

    // y + u − G M u/l⁴ with u = G S_I (2M)⁻¹ h, G = (K + M/l⁴)⁻¹, h = −½ S y + c, for a surface y (3 × local vertices)
    // with the fixed vertices at `boundary`. That is the b with the least Σ M |b − y|² + l⁴ |h(b)|²/M, once for y and
    // once more for what was left of it. Waves of length `wavelength` (units of D) keep half of their height. Nothing
    // where the patch has degenerated. Throws Cancelled.
    [[nodiscard]] std::optional<Points> without(const Points& surface, double wavelength, const Progress& progress);

private:
    const Patch& patch_;
    const Stiffness& stiffness_;
    Points boundary_;
    Points conormals_;  // c
    BiharmonicOperator smoothing_;
    double factorised_for_ = 0.0;  // this wavelength; 0: none
};

// The skin of the old patch itself. `wavelength`: that of the slopes, too.
std::optional<Points> old_base(const Patch& patch, const Stiffness& stiffness, const OldPatch& old, double wavelength,
                               const Progress& progress);

// The old patch x = base + detail d. On a new base d is turned triangle by triangle and put together again from its
// gradients (Yu et al. 2004, Botsch et al. 2006): S y = Σ cot R (d_i − d_j), y given at fixed vertices. R turns a
// triangle of the old base into the new one; S and the cotangents belong to x.
class Skin {
public:
    // `wavelength` as in old_base. Null where no detail can be read off, because triangles have no area. Keeps the
    // patch. Throws Cancelled.
    static std::unique_ptr<Skin> read(const Patch& patch, const OldPatch& old, double wavelength,
                                      const Progress& progress);

    // 3 × local vertices.
    [[nodiscard]] const Points& base() const { return base_; }
    // y at the free vertices, in units of `old`, for a new base (3 × local vertices, of any size) and y at the fixed
    // ones (3 × k): d itself where the new base is the old one and y there is d.
    [[nodiscard]] Points detail_on(const Points& new_base, const Points& at_boundary) const;
    // Local numbers of the triangles that the detail turns over on the new base and did not on the old one.
    // `shown`: the new base with its detail.
    [[nodiscard]] Indices turned_over(const Points& new_base, const Points& shown) const;

private:
    Skin(const Patch& patch, const Points& old);
    // False where the old patch has degenerated.
    [[nodiscard]] bool split(const OldPatch& old, double wavelength, const Progress& progress);
    // Columns, for triangle t: Σ cot (f_i − f_j) at its corners, the columns.
    [[nodiscard]] Eigen::Matrix3d pull(int t, const Points& field) const;
    [[nodiscard]] Points sources(const Points& new_base, const Points& at_boundary) const;

    const Patch& patch_;
    Points base_;
    Points detail_;
    FaceGeometry faces_;  // of the old patch
    LaplaceOperator laplacian_;
};

// The rotation next to the linear map that takes one triangle to the other and its normal to the other's: the rotation
// of that map's polar decomposition. Columns are corners. The identity where either triangle has no area.
Eigen::Matrix3d turn_of_triangle(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to);

// The surface `points` (3 × local vertices, D = 1) with the free vertices slid to where the conformal weights of `base`
// put them, so that triangles keep their shapes from one base to the other. Stays as it is where that turns over more
// triangles than are in `points` and `base` together. `base`: any unit and place. Throws Cancelled.
Points relaid(const Problem& problem, const Points& points, const Points& base, const Progress& progress);

}  // namespace fairing
