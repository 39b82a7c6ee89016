// The old patch without its detail: what is left of a shape when everything shorter than a wavelength is taken away.
#pragma once

#include <optional>

#include "base/progress.h"
#include "geometry/face_geometry.h"

namespace fairing {

struct OldPatch {
    const Points& points;   // 3 × local vertices, D = 1
    const Points& outline;  // 3 × fixed vertices: where the base meets its outline
};

// Twelve mean edges of the old patch (3 × local vertices, D = 1), but 0.4 D at most: a patch of a few edges has no
// detail.
double detail_wavelength(const Patch& patch, const Points& old);

// x + u − G M u/l⁴ with u = G S_I (2M)⁻¹ h, G = (K + M/l⁴)⁻¹, h = −½ S x + c (3 × local vertices), fixed vertices at
// `outline`. That is the b with the least Σ M |b − x|² + l⁴ |h(b)|²/M, once for x and once more for what was left of
// it. S and M belong to the old patch x; c holds the low-pass slopes at which x itself meets its outline. Waves of
// length `wavelength` (units of D) keep half of their height. `stiffness`: of `old`. Nothing where the patch has
// degenerated. Throws Cancelled.
std::optional<Points> old_base(const Patch& patch, const Stiffness& stiffness, const OldPatch& old, double wavelength,
                               const Progress& progress);

}  // namespace fairing
