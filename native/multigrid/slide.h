// Moving vertices within a surface that is known from its own mesh alone.
#pragma once

#include "solver/problem.h"
#include "solver/tangential_step.h"

namespace fairing {

// Vertices nearer to their inner-fairness positions, along the surface as their one-rings show it: some accelerated
// tangential steps, each of which follows the curvature. `points`: 3 × local vertices.
void slide(const Problem& problem, const TangentialStep& tangential, Points& points);

}  // namespace fairing
