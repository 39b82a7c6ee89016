// Which surfaces between two outlines may be bulbs or waists where a plain tube would do.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"

namespace fairing {

// A cheap look before the variation of its curvature is measured (method/otherwise). `points`: 3 × local vertices.
// False for tubes that are too short for a bulb, and for those that lie on the tube swept between their outlines.
bool may_be_bulb(const Problem& problem, const Points& points, const Progress& progress);

}  // namespace fairing
