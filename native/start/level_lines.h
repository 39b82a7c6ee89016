// Level lines of functions on a patch.
#pragma once

#include "base/types.h"

namespace fairing {

// Length of the part of a level line within one triangle; 0 elsewhere. `values`: of all vertices; `points`: 3 × the
// same.
double length_within(const Eigen::Vector3i& corners, const VectorX& values, double level, const Points& points);

}  // namespace fairing
