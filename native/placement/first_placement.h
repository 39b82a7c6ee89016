// First guesses of where the user's vertices lie on the surface of a proxy.
#pragma once

#include "placement/place.h"
#include "proxy/proxy_mesh.h"

namespace fairing {

// From the history of the proxy mesh. Removed vertices are inserted in reverse order, each at the mean of the ring that
// it left. The others are vertices of the target, whose patch is `snapshot`, the last one of the proxy mesh. After many
// collapses on a crumpled start rings may span two sheets.
Placement by_history(const Problem& problem, const ProxyMesh& mesh, const ProxyMesh::Snapshot& snapshot,
                     const TargetSurface& target);

// From another surface of the problem's own patch (3 × local vertices), which has the right sheets. Vertices follow one
// another from the boundary inwards. Each walks from where its neighbours are to the place nearest to its own on that
// surface. `target` belongs to `proxy`, whose fixed vertices are the problem's, in their order.
Placement by_surface(const Problem& problem, const Points& surface, const Patch& proxy, const TargetSurface& target);

}  // namespace fairing
