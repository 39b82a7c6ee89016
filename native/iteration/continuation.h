// From the globalised surface to the solution of any outer equation.
#pragma once

#include "base/progress.h"
#include "iteration/accelerated_iteration.h"
#include "operators/normal_operator.h"
#include "problem/solution.h"
#include "problem/surface_state.h"

namespace fairing {

// Of the whole load: the least one that is tried where a larger one is too much.
inline constexpr double smallest_increment = 1.0 / 32.0;

// The accurate iteration; for a constant load after the harmonic solution, and in steps of the load where a single
// one is too much. What comes back belongs to the whole load or says that it did not converge.
Solution solve_equation(const Problem& problem, Workspace& work, const Points& start, const Progress& progress);

// What K leaves out of the derivative of the outer equation.
// H changes by ½ (Δu + (κ₁² + κ₂²) u) where a surface moves by u along its normals, and K knows the first term alone:
// its answers u are too short by T u + T² u + …, T = ½ K⁻¹ S (κ₁² + κ₂²); by 4 to 30 % of the smooth part. Adds that to
// moves that K has answered, where the equation has no other terms. On small levels T u is solved for, and `share`, the
// size of T where it counts, is stored. Larger ones use the share that a coarser level has stored: a solve there costs
// more than it saves.
void add_reaction(const Problem& problem, const SurfaceState& state, const NormalOperator& normal, double& share,
                  VectorX& u);

}  // namespace fairing
