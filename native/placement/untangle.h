// Turns folded triangles of a placement back by spreading the vertices around them.
#pragma once

#include "placement/place.h"

namespace fairing {

// Around folded triangles the vertices move, one after the other in their tangent planes, down the energy of
// V. Garanzha et al., "Foldover-free maps in 50 lines of code", 2021: Σ (shape + ¼ (δ² + 1)) / χ(δ) with δ the signed
// area of a triangle over the mean one, and χ(δ) = (δ + √(ε² + δ²))/2, whose ε shrinks with the most negative δ. The
// region grows where folds stay.
void untangle(const Problem& problem, const TargetSurface& target, Placement& placement);

}  // namespace fairing
