// Surroundings that are broken along creases.
#pragma once

#include <array>

#include "base/types.h"

namespace fairing {

struct BrokenSurface {
    Triangles triangles;   // of copies
    Indices input_vertex;  // copy → vertex
};

// The triangles taken apart along edges: a vertex has one copy for each fan that is left at it.
// Precondition: three different vertices in each triangle.
BrokenSurface broken_along(const Triangles& triangles, int vertex_count, const std::vector<std::array<int, 2>>& edges);

}  // namespace fairing
