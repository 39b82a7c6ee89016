// Fair curves between two places.
#pragma once

#include "base/types.h"

namespace fairing {

// Where a curve begins or ends. `direction`: the way it runs there, from beginning to end, of any length; zero: free.
struct CurveEnd {
    Vector3 place;
    Vector3 direction;
};

// Places on the curve of least L³ ∫ κ'² + κ²τ² ds between the ends, at `shares` (0 … 1) of its length: the
// scale-invariant minimum variation curve (H. P. Moreton, C. H. Séquin 1993) whose curvature varies as a vector of the
// normal plane. Straight lines and circles cost nothing and come back exactly; a helix to 1e-3 of its chord over a
// quarter turn. Moves, turns and scales with its ends. Throws std::invalid_argument where both ends are in one place.
Points least_variation_curve(const CurveEnd& begin, const CurveEnd& end, const VectorX& shares);

}  // namespace fairing
