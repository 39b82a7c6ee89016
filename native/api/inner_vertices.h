// Adds inner vertices to a patch of few large faces that has no free vertex of its own.
#pragma once

#include "geometry/hard_edges.h"

namespace fairing {

// The same surface with more triangles.
struct RefinedPatch {
    Points vertices;  // the given ones come first
    Triangles triangles;
    Indices parent;  // the given triangle that each lies in,
    Points corners;  // and where its corners lie there: column 3 t + k has the weights of corner k
};

// Edges inside that are not `kept` are halved four times, and triangles without such an edge get a vertex in their
// middle. Nothing where some vertex is free already or a vertex inside is held.
std::optional<RefinedPatch> with_inner_vertices(const Points& points, const Triangles& triangles,
                                                const std::optional<Indices>& fixed, const VertexPairs& kept);

}  // namespace fairing
