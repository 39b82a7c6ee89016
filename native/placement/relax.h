// Inner fairness on a surface that stays: vertices slide to where their weights want them.
#pragma once

#include "base/progress.h"
#include "placement/placement.h"
#include "tangential/tangential_step.h"

namespace fairing {

enum class Folds { allowed, held_back };

// Minimises Σ λ_ij |x_i − x_j|² on the surface: tangential conjugate gradient steps, each followed by a walk back to
// the surface, accelerated, shortened until the sum no longer grows. `held_back`: vertices of triangles that a step
// would turn over stay where they are in that step. Gives the merit that is reached (tangential_step.h).
double relax(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
             Placement& placement, Folds folds = Folds::allowed);

// Relaxes, weights that aren't symmetric by way of their symmetric part: they have no energy to descend.
double settle(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
              Placement& placement, const Progress& progress);

}  // namespace fairing
