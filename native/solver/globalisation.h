// From the fill to a surface close enough for the accurate iteration, by mixed finite elements.
#pragma once

#include <memory>

#include "solver/normal_operator.h"
#include "solver/problem.h"
#include "solver/tangential_step.h"

namespace fairing {

// What the stages of a solve share.
struct Workspace {
    std::unique_ptr<NormalOperator> normal;  // of the equation: biharmonic, or Laplace for minimal surfaces
    std::unique_ptr<TangentialStep> tangential;
    bool keeps_factor = false;  // `normal` holds the factor of a surface near the start, which the iteration leaves
};

// Positions of all vertices: Willmore descent, then fixed-point steps of mixed finite elements (H_mixed ← harmonic, and
// within the surface). Never more energy than the start has. `start`: 3 × local vertices.
Points globalise(const Problem& problem, Workspace& work, const Points& start, const Progress& progress);

// One step of Willmore descent along u = −(½ S_I M⁻¹ S_Iᵀ)⁻¹ ⟨∇E, n⟩ with a line search.
struct DescentStep {
    Points points;  // 3 × local vertices
    double length;  // largest |u| before the line search, units of D; 0 when no step lowers the energy
    double energy;
};
DescentStep descent_step(const Problem& problem, Workspace& work, const Points& start, const Progress& progress);

// Fill of the outline that has the least Willmore energy of a few bulges (3 × local vertices).
Points best_fill(const Problem& problem, Workspace& work, const Progress& progress);

}  // namespace fairing
