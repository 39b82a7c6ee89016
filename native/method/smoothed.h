// The shape before, as smooth as it can be: where no equation joins several outlines, and no loft does better.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// All of the shape before is smoothed (start/shape_before), between the tangent planes given. Around its blemishes
// (method/blemishes) what is longer than D stays, then D/2, …, and a unit longer with each unit of way from there,
// until there are none. Nothing for one outline, where no shape before is known, or none is accepted.
std::optional<Solution> smoothed(const Problem& problem, const Solution& first, const Progress& progress);

// Whether a surface has blemishes, or lies aside of the shape before, so that smoothing that is worth trying.
bool is_blemished(const Problem& problem, const Solution& solution, const Progress& progress);

// Whether triangles between several outlines pass through each other that did not before.
bool crosses_anew(const Problem& problem, const Solution& solution);

}  // namespace fairing
