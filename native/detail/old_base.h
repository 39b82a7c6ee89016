// The old patch without its detail: what is left of a shape when everything shorter than a wavelength is taken away.
#pragma once

#include <optional>

#include "base/progress.h"
#include "geometry/face_geometry.h"

namespace fairing {

// Ten mean edges of the old patch (3 × local vertices, D = 1), but a quarter of D at most: a patch of a few edges has
// no detail.
double detail_wavelength(const Patch& patch, const Points& old);

// x + u − G M u/l⁴ with u = G S_I (2M)⁻¹ h, G = (K + M/l⁴)⁻¹, h = −½ S x + c (3 × local vertices). That is the b with
// the least Σ M |b − x|² + l⁴ |h(b)|²/M, once for x and once more for what was left of it. S, M and h belong to the old
// patch x; c holds the slopes at which x itself meets its outline. Waves of length `wavelength` (units of D) keep half
// of their height. Fixed vertices stay. `stiffness`: of `old`. Nothing where the patch has degenerated. Throws
// Cancelled.
std::optional<Points> old_base(const Patch& patch, const Stiffness& stiffness, const Points& old, double wavelength,
                               const Progress& progress);

}  // namespace fairing
