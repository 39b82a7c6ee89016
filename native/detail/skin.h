// The detail of an old patch, put back on the surface that replaces it.
#pragma once

#include "detail/old_base.h"
#include "operators/laplace_operator.h"

namespace fairing {

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
    [[nodiscard]] Points detail_on(const Points& new_base, const Points& at_outline) const;
    // Local numbers of the triangles that the detail turns over on the new base and did not on the old one.
    // `shown`: the new base with its detail.
    [[nodiscard]] Indices turned_over(const Points& new_base, const Points& shown) const;

private:
    Skin(const Patch& patch, const Points& old);
    // False where the old patch has degenerated.
    [[nodiscard]] bool split(const OldPatch& old, double wavelength, const Progress& progress);
    // Of triangle t: Σ cot (f_i − f_j) at its corners, the columns.
    [[nodiscard]] Eigen::Matrix3d pull(int t, const Points& field) const;
    [[nodiscard]] Points sources(const Points& new_base, const Points& at_outline) const;

    const Patch& patch_;
    Points base_;
    Points detail_;
    FaceGeometry faces_;  // of the old patch
    LaplaceOperator laplacian_;
};

}  // namespace fairing
