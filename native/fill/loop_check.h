// What stops a boundary from bounding a surface. Each function throws MeshError.
#pragma once

#include "base/errors.h"
#include "base/types.h"

namespace fairing {

// About some vertices, whose number is a figure.
Diagnostic at_vertices(Code code, const std::string& text, Indices vertices, Figures figures = {});

// NOT_A_LOOP: fewer than three vertices, an edge without length. NONFINITE. NONMANIFOLD_VERTEX: loops without triangles
// that pass a vertex twice, vertices of the boundary in one place or on its edges, edges that cross unless these may.
// `is_bare`: of each loop.
void check_boundary(const std::vector<Indices>& loops, const std::vector<char>& is_bare, const View<Points>& points,
                    bool may_cross);

// NOT_A_LOOP: an edge is passed twice, by one loop or by two.
void refuse_shared_edges(const std::vector<Indices>& loops);

}  // namespace fairing
