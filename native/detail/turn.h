// How a triangle turns from one place to another.
#pragma once

#include "base/types.h"

namespace fairing {

// The rotation next to the linear map that takes one triangle to the other and its normal to the other's: the rotation
// of that map's polar decomposition. Columns are corners. The identity where either triangle has no area.
Eigen::Matrix3d turn_of_triangle(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to);

}  // namespace fairing
