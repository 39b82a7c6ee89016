// Fair curves between two places.
#pragma once

#include "base/types.h"

namespace fairing {

// Where a curve begins or ends. `direction`: the tangent there, pointing from the beginning to the end, any length;
// zero: free.
struct CurveEnd {
    Vector3 place;
    Vector3 direction;
};

// Places on a curve between the ends, at `shares` (0 … 1) of its length: it blends the circle through both ends along
// the first direction into the circle along the last one (C. H. Séquin, K. Lee, J. Yen 2005). Straight lines and
// circles come back exactly; a helix to 3e-3 of its chord over a quarter turn. Its curvature varies little more (a
// sixth in the median) than that of the curve of least variation. Moves, turns and scales with its ends. Throws
// std::invalid_argument where both ends are in one place.
Points fair_curve(const CurveEnd& begin, const CurveEnd& end, const VectorX& shares);

}  // namespace fairing
