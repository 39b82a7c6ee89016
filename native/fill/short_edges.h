// Boundaries with edges far shorter than those around: what the first, coarse surface does without.
#pragma once

#include "fill/loop_sides.h"

namespace fairing {

// The mean of the normals at vertices that short edges join: fitted ones are some hundredths of a radian off. Over a
// fiftieth of an edge that asks for a radius of curvature of an edge: the search for a surface that turns so sharply
// took up to 20 s, on a mesh as fine as the shortest edge.
void share_normals(BoundaryLoop& loop);

// Loops without the vertices at the heads of edges shorter than a fiftieth of those around; three stay at least.
struct ThinnedLoops {
    std::vector<Indices> loops;
    std::vector<Points> normals;
    std::vector<std::array<int, 3>> left_out;  // each between those before and after it, as they come back

    // Triangles over these loops over all of the boundary: those at its long edges are cut where vertices were left
    // out.
    [[nodiscard]] Triangles with_all(const Triangles& triangles) const;
};

// Appends a loop of these vertices.
void add_thinned(ThinnedLoops& thinned, const Indices& vertices, const LoopShape& shape);

}  // namespace fairing
