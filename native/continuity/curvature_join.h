// Surfaces that also meet a prescribed mean curvature at their boundary (G2).
#pragma once

#include "base/progress.h"
#include "continuity/known_curvature.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Δ_B² H = 0 with positions, normals and H given: the multipliers of the boundary (continuity/join_operator) let Δ_B H
// leave zero there, and it is harmonic inside. Off the curves of `known` it stays zero, as it is for Δ_B H = 0.
// `start`: 3 × local vertices, the surface of the problem with Δ_B H = 0. The residual that comes back is the largest
// difference of Δ_B H from a harmonic function, its history of levels and ways is empty. `vertices_per_wave`: of the
// fastest waves of H that are met (continuity/outline_modes).
Solution join_curvatures(const Problem& problem, const KnownCurvature& known, const Points& start,
                         int vertices_per_wave, const Progress& progress);

}  // namespace fairing
