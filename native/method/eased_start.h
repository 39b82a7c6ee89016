// The coarse proxy over an eased outline: where the eased way begins, and what tells the proxy's whether it is in vain.
#pragma once

#include <memory>

#include "base/progress.h"
#include "problem/problem.h"
#include "proxy/proxy_solver.h"

namespace fairing {

// Of the problem's coarsest level, whose outline has all vertices.
struct EasedStart {
    CoarseProxy proxy;
    Points membrane;

    [[nodiscard]] bool found() const { return proxy.end == CoarseEnd::converged; }
};

// Whether that tells: of large patches with one jagged outline.
bool begins_eased(const Problem& problem);

// `found` is false where no coarse surface is found over the eased outline. Of 50 regions of scans with one outline and
// 10,000 or 30,000 free vertices where that was so none was solved over it, nor over its own outline without folds.
std::shared_ptr<const EasedStart> eased_start(const Problem& problem, const Progress& progress);

}  // namespace fairing
