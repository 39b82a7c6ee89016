// Ways over a patch's edges between the ends of hard edges of its surroundings.
#pragma once

#include "base/types.h"
#include "geometry/hard_edges.h"

namespace fairing {

// Edges of the paths between vertices that belong together (two, or more that meet in a vertex), the smaller index
// first, ascending: those that are hard as far as can be. None where less than three quarters of a path are hard.
// `edges`: those that may be used, ascending; `hard`: some of these. Throws what checkpoint() throws.
VertexPairs hard_paths(const View<Points>& points, const VertexPairs& edges, const VertexPairs& hard,
                       const std::vector<Indices>& ends);

}  // namespace fairing
