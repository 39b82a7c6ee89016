// Hard edges: where a mesh bends far more than around them.
#pragma once

#include "base/types.h"

namespace fairing {

using VertexPairs = std::vector<std::array<int, 2>>;

// Degrees by which a hard edge bends beyond what is usual across its direction, within three rings on both sides
// (DihedralBands::usual_across).
inline constexpr double hard_bend = 35.0;
// Chains of hard edges continue along edges that exceed the usual bend by half of that.
inline constexpr double fading_bend = 0.5 * hard_bend;

// Hard edges, smaller index first, ascending. An edge with two triangles is hard where it bends by at least `hard_bend`
// beyond the usual (or has the greatest part of such a bend over three rows: a crease between two rows), or continues
// such edges with at least `fading_bend`, in a chain of four edges or in a shorter one between corners or borders.
// Bends to the other side count as usual, too, so that noise has no hard edges. `marked` edges of the triangles
// are hard anyway. Triangles that name a vertex twice are left out.
VertexPairs hard_edges(const Points& points, const Triangles& triangles, const VertexPairs& marked);

}  // namespace fairing
