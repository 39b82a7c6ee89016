// The old patch without its detail, that is without what is shorter than a wavelength.
#pragma once

#include <optional>

#include "base/progress.h"
#include "operators/biharmonic_operator.h"

namespace fairing {

struct OldPatch {
    const Points& points;   // 3 × local vertices, D = 1
    const Points& outline;  // 3 × fixed vertices: where the base meets its boundary
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
    // with the fixed vertices at `outline`. That is the b with the least Σ M |b − y|² + l⁴ |h(b)|²/M, once for y and
    // once more for what was left of it. Waves of length `wavelength` (units of D) keep half of their height. Nothing
    // where the patch has degenerated. Throws Cancelled.
    [[nodiscard]] std::optional<Points> without(const Points& surface, double wavelength, const Progress& progress);

private:
    const Patch& patch_;
    const Stiffness& stiffness_;
    Points outline_;
    Points conormals_;  // c
    BiharmonicOperator smoothing_;
    double factorised_for_ = 0.0;  // this wavelength; 0: none
};

// Of the old patch itself. `wavelength`: of the slopes, too.
std::optional<Points> old_base(const Patch& patch, const Stiffness& stiffness, const OldPatch& old, double wavelength,
                               const Progress& progress);

}  // namespace fairing
