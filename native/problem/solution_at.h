// A solution at given points.
#pragma once

#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// The surface at `points` (3 × local vertices) as a converged solution with its boundary normals; not judged (`flaw`
// stays absent), and its mean curvature is left open.
Solution solution_at(const Problem& problem, const Points& points, Provenance provenance);

}  // namespace fairing
