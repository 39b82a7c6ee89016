// The edges of a triangle list and the triangle sides on each of them; any number of sides, any winding.
#pragma once

#include "base/types.h"

namespace fairing {

// Side 3 t + k of the list runs from corner k to corner k + 1 of triangle t.
struct EdgeTable {
    std::vector<std::array<int, 2>> ends;  // smaller index first; edges sorted
    Indices begin;                         // sides of edge e: sides[begin[e]] … sides[begin[e + 1] − 1]
    Indices sides;
    Indices edge_of_side;

    [[nodiscard]] int size() const { return static_cast<int>(ends.size()); }
    [[nodiscard]] int side_count(int edge) const { return begin[edge + 1] - begin[edge]; }
    [[nodiscard]] int side(int edge, int k) const { return sides[begin[edge] + k]; }
};

// Precondition: indices in [0, vertex_count), three different ones in each triangle.
EdgeTable make_edges(const Triangles& triangles, int vertex_count);

// Where side s starts and ends.
inline int side_tail(const Triangles& triangles, int side) { return triangles(side % 3, side / 3); }
inline int side_head(const Triangles& triangles, int side) { return triangles((side % 3 + 1) % 3, side / 3); }

}  // namespace fairing
