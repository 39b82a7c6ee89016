// Holes that take no vertex, or one.
#pragma once

#include "fill/loop_sides.h"
#include "geometry/hard_edges.h"

namespace fairing {

// Whether but for its two ends all of a loop lies on its other side, within a tenth of an edge.
bool is_crack(const LoopShape& loop);

// Whether faces close a loop without a new vertex: it has three edges, or four, none of them longer than those wanted
// (a new vertex would lift the surface of a flat place by as much as the fitted normals are off, over half an edge), or
// it is a crack, which runs back where it came from. `spacing`: 0 for the loop's own edges.
bool takes_no_vertex(const LoopShape& loop, double spacing);

// Triangles over such a loop. Of two diagonals the one whose triangles face as the surroundings do, unless it is an
// edge of `around` already; over a crack those of least area. Nothing where they need such an edge.
std::optional<Triangles> face_over(const BoundaryLoop& loop, const Triangles& around);

// Degrees at each vertex of the loop between its normal and that of the face over it, area by area.
VectorX angles_of_face(const BoundaryLoop& loop, const Triangles& face);

// Whether a fan around the hub is a good mesh over a loop of five to eight edges.
bool takes_hub(const LoopShape& loop, const Vector3& hub);

// Between a loop and its hub.
Triangles fan(const Indices& loop, int hub);

}  // namespace fairing
