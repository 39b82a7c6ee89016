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
    TangentialStep tangential;
};

// Positions of all vertices. First fixed-point steps H_mixed ← harmonic: along the normals, then within the surface
// too. Where the Willmore energy rises, a line search along its preconditioned gradient takes over. Never returns a
// surface with more energy than the start's. `start`: 3 × local vertices.
Points globalise(const Problem& problem, Workspace& work, const Points& start, const Progress& progress);

// Fill of the outline that has the least Willmore energy of a few bulges (3 × local vertices).
Points best_fill(const Problem& problem, Workspace& work, const Progress& progress);

}  // namespace fairing
