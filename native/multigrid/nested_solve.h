// The global method from coarse to fine over the user's own connectivity.
#pragma once

#include <functional>
#include <optional>

#include "solver/problem.h"

namespace fairing {

using CoarseSolver = std::function<Solution(const Problem&, const Progress&)>;

// Solves the problem's coarsest level with `solve_coarsest` and refines: each level starts at the surface of the one
// before and needs a few accelerated iterations, whose linear systems are solved by multigrid. No Solution where the
// patch is too small for levels or a level fails to converge soon: the caller then knows better ways.
std::optional<Solution> solve_nested(const Problem& problem, const CoarseSolver& solve_coarsest,
                                     const Progress& progress);

}  // namespace fairing
