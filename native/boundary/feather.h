// A band around a patch whose weights fade out.
#pragma once

#include "base/types.h"

namespace fairing {

// One weight for each of `points`: 1 at the corners of `inside`, 1 − s² (3 − 2 s) with s = d/width around it, 0 from
// `width` on and where no triangle is: slope 0 at both ends. d: straight distance to the nearest edge that both lists
// share, found by a walk over `outside` that does not pass `stops`. Their weight is 0. Coordinates must be finite where
// triangles are.
VectorX feather_weights(const Points& points, const Triangles& inside, const Triangles& outside, double width,
                        const Indices& stops = {});

}  // namespace fairing
