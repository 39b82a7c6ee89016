// Which sides of triangles lie on each other. Side 3 t + k runs from corner k to corner k + 1 of triangle t.
#pragma once

#include "base/types.h"
#include "mesh/edges.h"

namespace fairing {

// For each side the one on the other triangle of its edge, `none` at borders.
using Twins = Indices;

// Across the edges that join two triangles and are not cut.
Twins twins_across(const EdgeTable& edges, const std::vector<char>& cut);

// A side of a non-manifold or inconsistently wound edge, which can't be joined to the others there.
using Misfit = std::optional<int>;

// Joins the sides without a twin that run to and fro between two vertices.
Misfit join_borders(const Triangles& triangles, Twins& twins);

// The twins of a triangle list, from its vertices alone.
Misfit find_twins(const Triangles& triangles, int vertex_count, Twins& twins);

// Triangles that are wound against most of those which edges of two triangles connect them with; ascending. None in a
// piece that has one side only. Precondition: as for make_edges.
Indices turned_triangles(const Triangles& triangles, int vertex_count);

// Triangles that name a vertex twice.
// The others, in their order.
Triangles without_collapsed(const Triangles& triangles);

}  // namespace fairing
