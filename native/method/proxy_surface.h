// The robust strategy: the surface on a mesh of the engine's own, the user's vertices projected onto it, the equation
// then solved on the user's mesh where that carries it.
#pragma once

#include "accept/accept.h"
#include "base/progress.h"
#include "method/plan.h"
#include "operators/normal_operator.h"
#include "problem/solution.h"
#include "proxy/proxy_solver.h"

namespace fairing {

// The start for a large patch in one jagged loop: the surface over the low-passed loop, which also shows whether to go
// on. Of 50 regions of scans with 10,000 or 30,000 free vertices where that had no surface none was solved over it, nor
// over its own loop without folds.
struct CoarseStart {
    CoarseStart(const Problem& problem, const Traits& traits, const Progress& progress);

    // Nothing for other patches.
    std::optional<CoarseProxy> proxy;
    Points membrane;  // of the coarsest level, 3 × its vertices

    [[nodiscard]] bool is_in_vain() const { return proxy && proxy->end != CoarseEnd::converged; }
};

// Results of the strategies tried so far.
struct Attempts {
    std::vector<Solution> found;  // none of them accepted
    std::vector<StrategyTried> log;
    std::shared_ptr<const CoarseStart> start = {};  // once it is known

    // The latest surface on the user's own connectivity, or none.
    [[nodiscard]] const Solution* own_connectivity() const {
        for (std::size_t k = found.size(); k-- > 0;) {
            if (found[k].polished) return &found[k];
        }
        return nullptr;
    }
};

// Where the discrete equation holds on the user's own mesh near the projected vertices, that is the solution. Elsewhere
// it is the projected vertices with the H of the engine's mesh. It ends as `folded` where no placement without folds is
// found, or where the projected mesh crosses itself and the surface does not. What `attempts` have left helps to place
// the vertices. Nothing where no mesh of the engine's own carries the equation.
std::optional<Solution> solve_on_proxy_mesh(const Problem& problem, const Traits& traits, Attempts& attempts,
                                            const Progress& progress);

// The surface between the low-passed loops, where none meets the loops as given. The loops stay as given; triangles
// that are torn next to them are filled anew. Nothing where no surface is found.
std::optional<Solution> solve_low_passed(const Problem& problem, const Traits& traits, Attempts& attempts,
                                         const Progress& progress);

// Solves the discrete equation on the problem's mesh from `projected`, whose vertices lie on a solved surface. Nothing
// where it does not converge or is not accepted. `work` belongs to the problem.
std::optional<Solution> polished(const Problem& problem, Workspace& work, const Solution& projected,
                                 const Progress& progress);

}  // namespace fairing
