// The robust way for large patches: the proxy from a coarse level, the user's vertices placed level by level.
#pragma once

#include "method/on_proxy.h"
#include "method/proxy_start.h"

namespace fairing {

// As solve_on_proxy. The proxy begins with the vertices of a coarse level, so that nothing of the user's size is
// solved before its surface is known. Folds count on the finest level alone: coarse levels may have no placement
// without any. Where springs alone fold triangles, the equation's solution by them would be folded, too, and no polish
// is tried. Where the coarse proxies over the outline and over the eased one, `start` if it is known, find no surface,
// no fine one is solved. Nothing where the patch has no levels.
std::optional<Solution> solve_on_coarse_proxy(const Problem& problem, const std::optional<OwnSurface>& guess,
                                              const std::shared_ptr<const ProxyStart>& start, const Progress& progress);

// From nothing and without the polish: not for a surface that the problem's own mesh has no equal of. Nothing either
// where the proxy has no solution. `start`: where the proxy begins, if there is one.
std::optional<Solution> place_on_coarse_proxy(const Problem& problem, const std::shared_ptr<const ProxyStart>& start,
                                              const Progress& progress);

}  // namespace fairing
