// A solution at given points.
#pragma once

#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// The surface at `points` (3 × local vertices) as a converged solution, its mean curvature and its boundary normals
// measured, and not judged: `flaw` stays absent.
Solution solution_at(const Problem& problem, const Points& points, Provenance provenance);

}  // namespace fairing
