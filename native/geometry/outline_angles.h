// How well a surface meets the normals along its boundary.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Degrees between the prescribed normals and the surface's own (3 × fixed count, local order); zero at pins and where
// no free vertex is adjacent.
VectorX boundary_angles(const Patch& patch, const Points& actual, const Points& prescribed);

}  // namespace fairing
