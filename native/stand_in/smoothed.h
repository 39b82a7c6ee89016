// The shape before, as smooth as it can be: where no equation joins several outlines, and no loft does better.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// All of the shape before is smoothed (start/shape_before), between the tangent planes given. Around its blemishes
// (shape/blemishes) what is longer than D stays, then D/2, …, and a unit longer with each unit of way from there,
// until there are none. Nothing for one outline, where no shape before is known, or none is accepted.
std::optional<Solution> smoothed(const Problem& problem, const Progress& progress);

}  // namespace fairing
