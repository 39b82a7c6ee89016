// The robust way: the surface on a mesh of the engine's own, the user's vertices placed on it, the equation polished.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// A surface of the problem's own mesh that another way has left, positions of all vertices: on the right sheets.
struct OwnSurface {
    Points points;
    bool solved;  // the equation holds there
};

// `guess`: what the vertices are placed from, if there is anything. Where the discrete equation holds on the user's own
// mesh near the placed vertices, that is the solution. Elsewhere it is the placed vertices with the proxy's H. It ends
// as `folded` where no placement without folds is found, or where the placed mesh crosses itself and the proxy's
// surface does not. Where no proxy converges, the least bent of their surfaces comes back, not converged.
Solution solve_on_proxy(const Problem& problem, const std::optional<OwnSurface>& guess, const Progress& progress);

// From nothing and without the polish: not for a surface that the problem's own mesh has no equal of. Nothing where no
// proxy converges.
std::optional<Solution> place_on_proxy(const Problem& problem, const Progress& progress);

}  // namespace fairing
