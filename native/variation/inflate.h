// Opens collapsed tubes of an initial surface.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"

namespace fairing {

// Positions (3 × local vertices) near `start` whose edges are about as long as those of the nearest boundary loops:
// edges shorter than 0.8 of that want to be that long, in their present direction, and all others stay as they are.
Points inflated(const Problem& problem, const Points& start, const Progress& progress);

}  // namespace fairing
