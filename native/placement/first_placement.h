// First guesses of where the user's vertices lie on the surface of a proxy.
#pragma once

#include "placement/placement.h"
#include "proxy/proxy_mesh.h"

namespace fairing {

// By the history of the proxy mesh: removed vertices come back in reverse order, each at the mean of the ring that it
// left; the others are vertices of the target, whose patch is `snapshot`, the last one of the proxy mesh. After many
// collapses on a crumpled start rings may span two sheets.
Placement by_history(const Problem& problem, const ProxyMesh& mesh, const ProxyMesh::Snapshot& snapshot,
                     const TargetSurface& target);

// By another surface of the problem's own patch (3 × local vertices), which has the right sheets: from the outline
// inwards, vertex by vertex, each walks from where its neighbours are to the place that is nearest to its own on that
// surface. `target`: of `proxy`, whose fixed vertices are the problem's, in their order.
Placement by_surface(const Problem& problem, const Points& surface, const Patch& proxy, const TargetSurface& target);

}  // namespace fairing
