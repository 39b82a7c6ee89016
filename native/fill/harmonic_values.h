// Values on the boundary of a patch, continued over it harmonically.
#pragma once

#include <optional>

#include "mesh/patch.h"

namespace fairing {

// Rows: the free vertices; columns as those of `given`, whose rows are the fixed vertices. Discrete harmonic with
// cotangent weights, none below a thousandth: no value leaves the range of its column, up to rounding. A linear
// function of `points` (3 × local vertices) stays linear on a flat patch without wide angles. Returns nothing where the
// system can't be solved. Without fixed vertices all values are zero.
std::optional<Eigen::MatrixXd> harmonic_values(const Patch& patch, const Points& points, const Eigen::MatrixXd& given);

}  // namespace fairing
