// Pins that are led to their places on a mesh of the engine's own.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// As pins/spread_pins from the surface without pins (`start`, 3 × local vertices), for pins so far from it that one
// iteration does not converge, or that the vertices around them fold. The pins move in steps, and the mesh is made
// anew between them. Then the caller's vertices are projected onto the surface. Not judged yet; nothing where a step is
// not found however short.
std::optional<Solution> lead_pins(const Problem& problem, double radius, const Points& start, const Progress& progress);

}  // namespace fairing
