// The loops around holes, also where borders touch each other or themselves (pinches).
#pragma once

#include "base/types.h"

namespace fairing {

// Tail and head of each border edge, the hole on its left.
using BorderSides = std::vector<std::array<int, 2>>;

struct HoleLoops {
    std::vector<Indices> loops;  // closed, the hole on the left; each begins at its smallest vertex, ordered by it
    std::vector<Indices> torn;   // chains that don't close: the windings disagree at an end
};

// Edges with one triangle, in the order of the triangles' sides. Triangles that name a vertex twice have none.
BorderSides border_sides(const Triangles& triangles, int vertex_count);

// Around a vertex, fans of triangles and open sectors take turns. A loop goes through a sector: it comes from the fan
// at one end and leaves along the fan at the other. Surfaces over such loops close every sector, so that the mesh is a
// manifold there. (`boundary_loops` follow the fans instead, which would leave two umbrellas that touch in a point.)
// `triangles`: those with a vertex that the border passes several times are enough.
HoleLoops hole_loops(const View<Points>& points, const Triangles& triangles, const BorderSides& border);

// Splits a loop along the border, the hole on its left, likewise where it touches itself; a vertex that other
// loops pass, too, is left alone.
std::vector<Indices> parted_loop(const Indices& loop, const View<Points>& points, const Triangles& triangles);

}  // namespace fairing
