// From the fill to a surface close enough for the accurate iteration, by mixed finite elements.
#pragma once

#include "base/progress.h"
#include "operators/normal_operator.h"
#include "problem/problem.h"

namespace fairing {

// Steps of a descent, and the length below which it ends, units of D: what comes next does the rest.
inline constexpr int most_descent_steps = 40;
inline constexpr double descended = 5e-3;

// Positions of all vertices: Willmore descent, then fixed-point steps of mixed finite elements (H_mixed ← harmonic, and
// within the surface). The energy never exceeds the initial one. `start`: the initial surface, 3 × local vertices.
Points globalise(const Problem& problem, Workspace& work, const Points& start, const Progress& progress);

// One step of Willmore descent along u = −(½ S_I M⁻¹ S_Iᵀ)⁻¹ ⟨∇E, n⟩ with a line search.
struct DescentStep {
    Points points;  // 3 × local vertices
    double length;  // largest |u| before the line search, units of D; 0 when no step lowers the energy
    double energy;
};
DescentStep descent_step(const Problem& problem, Workspace& work, const Points& start, const Progress& progress);

}  // namespace fairing
