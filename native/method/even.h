// The surface by uniform weights, then the vertices placed on it by their own.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// The shape doesn't depend on λ. Where a mesh carries the equation only with its vertices evenly placed, that surface
// is taken and λ places them on it. Nothing where that is not accepted either.
std::optional<Solution> solve_evenly(const Problem& problem, const Progress& progress);

}  // namespace fairing
