// On a mesh of the engine's own for large patches: it is made from a coarse level, the user's vertices are projected
// level by level.
#pragma once

#include "method/plan.h"
#include "method/proxy_surface.h"

namespace fairing {

// Where the engine's mesh of a large patch begins whose one loop is jagged: at the surface between the low-passed
// loop, which shows whether more work is in vain. Of 50 regions of scans with 10,000 or 30,000 free vertices where
// that had no surface none was solved over it, nor over its own loop without folds.
struct CoarseStart {
    CoarseStart(const Problem& problem, const Traits& traits, const Progress& progress);

    // Nothing for other patches.
    std::optional<CoarseProxy> proxy;
    Points membrane;  // of the coarsest level, 3 × its vertices

    [[nodiscard]] bool is_in_vain() const { return proxy && proxy->end != CoarseEnd::converged; }
};

// Nothing of the user's size is solved before its surface is known. Folds count on the finest level alone: coarse
// levels may have no placement without any. Where springs alone fold triangles, the equation's solution by them would
// be folded, too, and it is not solved on the user's mesh.
std::optional<Solution> solve_on_coarse_proxy(const Problem& problem, const std::optional<OwnSurface>& guess,
                                              Polish polish, const CoarseStart& start, const Progress& progress);

}  // namespace fairing
