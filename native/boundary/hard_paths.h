// Paths over a patch's edges that join the ends of hard edges outside.
#pragma once

#include "base/types.h"
#include "geometry/hard_edges.h"

namespace fairing {

// Edges of the paths between vertices that belong together (two, or more that meet in a vertex), the smaller index
// first, ascending. They run along hard edges as far as possible. None for a path of which less than three quarters are
// hard. `edges`: those that may be used, ascending; `hard`: some of these. Throws what checkpoint() throws.
VertexPairs hard_paths(const View<Points>& points, const VertexPairs& edges, const VertexPairs& hard,
                       const std::vector<Indices>& ends);

}  // namespace fairing
