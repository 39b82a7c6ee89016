// Solves large patches on a proxy mesh made from a coarse level, and projects the user's vertices level by level.
#pragma once

#include "method/plan.h"
#include "method/proxy_surface.h"

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

// No system of the user's size is solved until the surface is known. Folds count on the finest level alone: coarse
// levels may have no placement without any. Where the inner fairness alone folds triangles, a solve with it would fold
// them, too, and it is not solved on the user's mesh.
std::optional<Solution> solve_on_coarse_proxy(const Problem& problem, const std::optional<OwnSurface>& guess,
                                              Polish polish, const CoarseStart& start, const Progress& progress);

}  // namespace fairing
