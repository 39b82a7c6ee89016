// Inner fairness on a surface that stays: vertices slide to where their weights want them.
#pragma once

#include "base/progress.h"
#include "mesh/patch.h"
#include "placement/place.h"
#include "tangential/tangential_step.h"

namespace fairing {

// Minimises Σ λ_ij |x_i − x_j|² on the surface: tangential conjugate gradient steps, each followed by a walk back to
// the surface, accelerated, shortened until the sum no longer grows.
void relax(const TangentialStep& tangential, const TargetSurface& target, Placement& placement);

// The free vertices within `rings` edges of some triangles moved to where Σ |d x_v − Σ x_w|² over all vertices v, with
// their d neighbours w, is least; the others stay. `points`: 3 × local vertices.
Points refilled(const Patch& patch, const Points& points, const Indices& triangles, int rings);

}  // namespace fairing
