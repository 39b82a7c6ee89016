// The robust strategy: the surface on a mesh of the engine's own, the user's vertices placed on it, the equation then
// solved on the user's mesh where that carries it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "method/traits.h"
#include "problem/solution.h"

namespace fairing {

class CoarseStart;  // method/coarse_own_mesh

// What the steps of a plan have come to so far.
struct Attempts {
    std::vector<Solution> found;  // none of them accepted
    std::vector<WayTaken> log;
    std::shared_ptr<const CoarseStart> start = {};  // of a large patch on the engine's own mesh, once it is known

    // The latest surface on the user's own connectivity, or none.
    [[nodiscard]] const Solution* own_connectivity() const {
        for (std::size_t k = found.size(); k-- > 0;) {
            if (found[k].polished) return &found[k];
        }
        return nullptr;
    }
};

// Where the discrete equation holds on the user's own mesh near the placed vertices, that is the solution. Elsewhere it
// is the placed vertices with the H of the engine's mesh. It ends as `folded` where no placement without folds is
// found, or where the placed mesh crosses itself and the surface does not. Where no mesh carries the equation, the
// least bent of their surfaces comes back, not converged. What `attempts` have left helps to place the vertices.
// Nothing where, over a large jagged patch, even the loops without their short waves have no surface.
std::optional<Solution> solve_on_own_mesh(const Problem& problem, const Traits& traits, Attempts& attempts,
                                          const Progress& progress);

// The surface between the low-passed loops, solved there, where none meets the loops as they are. These stay; the rows
// of vertices next to them follow where they lie beside that surface. Nothing where no surface is found.
std::optional<Solution> solve_low_passed(const Problem& problem, const Traits& traits, Attempts& attempts,
                                         const Progress& progress);

}  // namespace fairing
