// From a surface with tangent joins to one that carries the slopes of its boundary further in, or less far.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Δ_B (w (H − H₀)) = 0 with the boundary data of Δ_B H = 0 and the problem's tensions (operators/tension_weight).
// `tangent`: the answer with w = 1. It comes back, with the reason in `tension`, where it is no accepted solution of
// that equation on the patch's own mesh, where lone pins say nothing of a slope, and where no surface with w is
// accepted.
Solution tensed(const Problem& problem, Solution tangent, const Progress& progress);

}  // namespace fairing
