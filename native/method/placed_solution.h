// What the ways by a proxy share: when it begins from the user's own surface, and the solution that comes of it.
#pragma once

#include "method/accept.h"
#include "method/on_proxy.h"
#include "placement/place.h"
#include "proxy/proxy_solver.h"

namespace fairing {

// Whether a proxy begins from the surface of the user's own mesh.
bool starts_from(const Problem& problem, const OwnSurface& own);

// The user's vertices as they were placed on a proxy (`target`), with its H and normals; `folded` where no placement
// without folds was found on a surface that is one.
Solution placed_solution(const Problem& problem, const SolvedProxy& proxy, const TargetSurface& target,
                         const Placed& placed);

// The proxy's surface, for the polish to be compared with.
SolvedSurface surface_of(const SolvedProxy& proxy, const TargetSurface& target, const Placement& placement);

}  // namespace fairing
