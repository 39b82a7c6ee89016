// The edges at which a surface is broken: where a mesh bends far more than it does around there.
#pragma once

#include "base/types.h"

namespace fairing {

using VertexPairs = std::vector<std::array<int, 2>>;

// Degrees by which a hard edge bends beyond what is usual across its direction, within three rings on both sides
// (DihedralBands::usual_across).
inline constexpr double hard_bend = 35.0;
// Chains of hard edges run on along edges that exceed it by half of that.
inline constexpr double fading_bend = 0.5 * hard_bend;

// Hard edges, smaller index first, ascending. An edge with two triangles is hard that bends by `hard_bend` and more
// beyond the usual (or the greatest part of such a bend over three rows, as where a crease runs between two), or
// continues such edges by `fading_bend` and more, in a chain of four edges, or of fewer that end
// at nothing but the border or corners. Bends to the other side count as usual, too: noise has no hard edges. `marked`
// edges are hard wherever they are edges of the triangles. Triangles that name a vertex twice are left out.
VertexPairs hard_edges(const Points& points, const Triangles& triangles, const VertexPairs& marked);

}  // namespace fairing
