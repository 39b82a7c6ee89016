// A surface between loops without their short waves, where none meets the loops as they are.
#pragma once

#include <optional>

#include "base/progress.h"
#include "method/own_mesh.h"
#include "method/traits.h"
#include "problem/solution.h"

namespace fairing {

// The surface between the low-passed loops, solved on a mesh of the engine's own, the vertices placed on it. The loops
// themselves stay; the rows of vertices next to them follow where they lie beside that surface. Nothing where no
// surface is found.
std::optional<Solution> solve_low_passed(const Problem& problem, const Traits& traits, Attempts& attempts,
                                         const Progress& progress);

}  // namespace fairing
