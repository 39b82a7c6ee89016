// From coarse to fine over the user's own connectivity.
#pragma once

#include "base/progress.h"
#include "method/plan.h"
#include "problem/solution.h"

namespace fairing {

// Solves the coarsest level (method/direct) and refines: each level starts at the surface of the one before and
// needs a few accelerated iterations, whose linear systems are solved by multigrid. The descent ends at a level that
// starts folded or stays far from a surface, before the larger ones cost time, and on the finest one as soon as its
// steps hardly shrink. The solution then has not converged, and its positions are those of the last good level,
// interpolated; nothing is measured there. No solution where the patch is too small for levels.
std::optional<Solution> solve_nested(const Problem& problem, const Traits& traits, const Progress& progress);

// The surface that every run begins with: at once, and always. 3 × local vertices, finite. quick_surface
// (start/quick_surface), for large patches on a coarse level and interpolated from there. Where it has none: the old
// shape with the new boundary. Throws Cancelled.
Points first_surface(const Problem& problem, const Progress& progress);

}  // namespace fairing
