// From a surface that was solved on other vertices to the user's own.
#pragma once

#include <optional>

#include "accept/accept.h"
#include "base/progress.h"
#include "operators/workspace.h"
#include "placement/place.h"
#include "proxy/proxy_solver.h"

namespace fairing {

// A surface of the problem's own connectivity that another step has left, positions of all vertices.
struct OwnSurface {
    Points points;
    bool solved;  // the equation holds there

    // Whether a mesh of the engine's own may begin from it.
    [[nodiscard]] bool is_start(const Problem& problem) const;
};

// The user's vertices as they were placed on a proxy (`target`), with its H and normals; `folded` where no placement
// without folds was found on a surface that is one.
Solution placed_solution(const Problem& problem, const SolvedProxy& proxy, const TargetSurface& target,
                         const Placed& placed);

// Solves the discrete equation on the problem's mesh from `placed`, whose vertices lie on a solved surface. Gives that
// solution where it converges, agrees with that surface and is accepted, `placed` itself otherwise. `work` belongs to
// the problem.
Solution polished(const Problem& problem, Workspace& work, Solution placed, const SolvedSurface& surface,
                  const Progress& progress);

// The proxy's surface, for that comparison.
SolvedSurface surface_of(const SolvedProxy& proxy, const TargetSurface& target, const Placement& placement);

}  // namespace fairing
