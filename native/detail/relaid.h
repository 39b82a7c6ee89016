// Vertices of a solved surface slid to where detail can be put on them.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"

namespace fairing {

// The surface `points` (3 × local vertices, D = 1) with the free vertices slid to where the conformal weights of `base`
// put them, so that triangles keep their shapes from one base to the other. Stays as it is where that turns over more
// triangles than are in `points` and `base` together. `base`: any unit and place. Throws Cancelled.
Points relaid(const Problem& problem, const Points& points, const Points& base, const Progress& progress);

}  // namespace fairing
