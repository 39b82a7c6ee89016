// Where the variation of curvature is measured: a triangle and the vertices across its edges.
#pragma once

#include <array>

#include "mesh/patch.h"

namespace fairing {

// Corners a, b, c of a triangle, then the vertices opposite to it across bc, ca, ab; `none` across a border edge.
using Stencil = std::array<int, 6>;

inline constexpr int stencil_size = 6;  // the triangle's corners and those across its edges

// Pairs of stencil places along which the derivative of the normal curvature is known: the three edges, and each corner
// with the vertex across its opposite edge. Edges alone leave one of the four coefficients of a cubic open.
inline constexpr std::array<std::array<int, 2>, 6> stencil_pairs{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}}};

// One for each triangle.
std::vector<Stencil> stencils(const Patch& patch);

}  // namespace fairing
