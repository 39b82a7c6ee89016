// Gaussian curvature by the angles around vertices.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// 2π minus the angles around each free vertex, the integral of its Gaussian curvature; zero at the others. `points`: 3
// × local vertices.
VectorX angle_defects(const Patch& patch, const Points& points);

}  // namespace fairing
