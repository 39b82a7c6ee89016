// Boundary loops of a triangle list.
#pragma once

#include "base/types.h"
#include "mesh/patch.h"

namespace fairing {

// The closed loops of border edges, each in the direction of its triangles (the mesh on the left), starting at its
// smallest vertex; ordered by that vertex. At a vertex where several loops touch, each pass leaves through the fan
// of triangles that it came along. Throws NONMANIFOLD_EDGE at edges with more than two triangles, NOT_ORIENTABLE.
std::vector<Indices> boundary_loops(const Triangles& triangles, int vertex_count);

// The part of a patch around some of its vertices, as a triangle list of its own.
struct PatchStrip {
    Indices vertices;     // of the patch, ascending
    Indices local;        // vertex of the patch → its number in the strip, `none` outside
    Triangles triangles;  // in the strip's numbers, in the patch's order

    // Columns of the strip's vertices.
    [[nodiscard]] Points gather(const Points& points) const { return points(Eigen::all, vertices); }
};

// All triangles at the vertices within so many edges of `seeds`.
PatchStrip strip_around(const Patch& patch, const Indices& seeds, int edges);

// From triangles of a patch to their corners and back.
// Each once, ascending.
Indices corners_of(const Patch& patch, const Indices& triangles);

// Those with one of the vertices as a corner; each once, ascending.
Indices triangles_at(const Patch& patch, const Indices& vertices);

bool has_free_corner(const Patch& patch, int triangle);

// Those of some triangles that have one of the vertices, in their order.
Indices with_free_corner(const Patch& patch, Indices triangles);

}  // namespace fairing
