// The linear surface between several outlines that runs straight from one to the next.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"
#include "start/clamped_fill.h"

namespace fairing {

// `flat`: lines from the longest outline to the others. `bulge`: what the outline's tangent planes add, which they do
// less where the given normals turn by more than 30° along the outline, and not at all beyond 60°. Both by one linear
// solve on the patch's own connectivity. `roundness`: the middle of a straight tube without slopes has its radius
// divided by cosh(roundness / 2); where it is larger, ripples of the outline die sooner. Nothing for a patch with one
// outline, or with vertices held elsewhere.
std::optional<Fill> loft(const Problem& problem, double roundness, const Progress& progress);

}  // namespace fairing
