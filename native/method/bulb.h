// Which surfaces between several outlines may be bulbs or waists where plain tubes would do.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"

namespace fairing {

// A cheap look before the variation of its curvature is measured (method/otherwise). `points`: 3 × local vertices.
// False where tubes and arms are too short for a bulb, and for a tube that lies on the one swept between its outlines.
bool may_be_bulb(const Problem& problem, const Points& points, const Progress& progress);

}  // namespace fairing
