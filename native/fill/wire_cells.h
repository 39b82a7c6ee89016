// The cells of wires: loops that a surface is to fill, and those that stay open.
#pragma once

#include "fill/wire_network.h"

namespace fairing {

// Loops with their surface on the left, all of a network wound alike.
struct WireCells {
    std::vector<Indices> loops;
    Points normals;  // one for each loop
    std::vector<Indices> left_open;
    VertexPairs rims;  // around openings that are closed
};

// All cells, openings among them where `closed`. Throws what parted_wires() throws, and NO_CELL for wires that divide
// nothing or bound openings alone.
WireCells cells_of(const VertexPairs& wires, const View<Points>& points, bool closed);

// Which loop each triangle lies in: that of a wire along it, and then of its neighbours across other edges.
Indices cells_of_triangles(const Triangles& triangles, const std::vector<Indices>& loops, int vertex_count);

}  // namespace fairing
