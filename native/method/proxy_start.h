// Where the proxies of a large patch begin whose outline is jagged: at a surface over the eased outline, which tells
// whether they are in vain.
#pragma once

#include "base/progress.h"
#include "method/ways.h"
#include "problem/problem.h"
#include "proxy/proxy_solver.h"

namespace fairing {

// Of the coarsest level that keeps the whole outline.
struct ProxyStart {
    CoarseProxy proxy;
    Points membrane;
    bool led = false;  // by a coarse level of the user's mesh, whose finest level has ended nowhere

    [[nodiscard]] bool found() const { return proxy.end == CoarseEnd::converged; }
};

// Whether a coarse proxy over the eased outline tells: of large patches with one jagged outline.
bool begins_eased(const Problem& problem);

// Finds the situation's start, once: the surface that a coarse level of the user's mesh has, or else a coarse proxy
// over the eased outline where that tells. `found` is false where there is none. Of 50 regions of scans with one
// outline and 10,000 or 30,000 free vertices where that was so none was solved over it, nor over its own outline
// without folds. No start at all for other patches.
void find_start(const Problem& problem, Situation& situation, const Progress& progress);

}  // namespace fairing
