// Pins that lift or hold the surface over a radius instead of in a point.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Fixed vertices inside the patch none of whose neighbours is fixed, by their places among the fixed ones.
Indices isolated_pins(const Patch& patch);

// Solves Δ_B H = f + Σ_k λ_k g_k with every pin exactly at its place. g_k is a bell of standard deviation `radius`
// (units of D; pins/bells.h) around pin k; λ_k is its multiplier. H is then bounded at the pins, whatever the mesh,
// where Δ_B H = f alone lets it grow like the logarithm of the edge length. `start`: 3 × local vertices, near the
// surface; pins that are not at their places yet are led there. The solution's points come from there; its termination
// says whether the iteration has converged. Throws Cancelled.
Solution spread_pins(const Problem& problem, double radius, const Points& start, const Progress& progress);

}  // namespace fairing
