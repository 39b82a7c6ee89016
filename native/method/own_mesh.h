// The robust strategy: the surface on a mesh of the engine's own, the user's vertices placed on it, the equation then
// solved on the user's mesh where that carries it.
#pragma once

#include <optional>

#include "base/progress.h"
#include "method/attempts.h"
#include "method/traits.h"

namespace fairing {

// Where the discrete equation holds on the user's own mesh near the placed vertices, that is the solution. Elsewhere it
// is the placed vertices with the H of the engine's mesh. It ends as `folded` where no placement without folds is
// found, or where the placed mesh crosses itself and the surface does not. Where no mesh carries the equation, the
// least bent of their surfaces comes back, not converged. What `attempts` have left helps to place the vertices.
// Nothing where, over a large jagged patch, even the loops without their short waves have no surface.
std::optional<Solution> solve_on_own_mesh(const Problem& problem, const Traits& traits, Attempts& attempts,
                                          const Progress& progress);

// Placed alone: for a surface that the problem's own mesh has no equal of. Nothing where no mesh carries it.
// `traits`, `attempts`: of the problem whose loops may have been low-passed since.
std::optional<Solution> place_on_own_mesh(const Problem& problem, const Traits& traits, Attempts& attempts,
                                          const Progress& progress);

}  // namespace fairing
