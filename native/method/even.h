// The surface by uniform weights, then the vertices placed on it by their own.
#pragma once

#include <optional>

#include "solver/problem.h"

namespace fairing {

// The shape doesn't depend on λ: where a mesh carries the equation with its vertices evenly placed only, that surface
// is taken and λ places them on it. Nothing where even that is not accepted.
std::optional<Solution> solve_evenly(const Problem& problem, const Progress& progress);

}  // namespace fairing
