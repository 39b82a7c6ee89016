// Edges in space that touch or cross each other, and vertices that lie on edges or on each other.
#pragma once

#include "base/types.h"
#include "geometry/hard_edges.h"

namespace fairing {

// The edges of a closed loop, in its direction.
VertexPairs edges_around(const Indices& loop);

// The four ends of each two edges that touch (nearer than 1e-9 of the extent) without a common vertex there.
std::vector<std::array<int, 4>> crossing_edges(const VertexPairs& edges, const View<Points>& points);

double distance_to_segment(const Vector3& point, const Vector3& begin, const Vector3& end);  // or to an end

struct Touches {
    std::vector<std::array<int, 3>> on_edges;  // the ends of an edge, and a vertex that lies on it between them
    VertexPairs pairs;                         // coincident vertices, the smaller index first
};

// Vertices nearer than 1e-5 of an edge to that edge, or to an end of it that no edge joins to them; each once,
// ascending.
Touches touching_edges(const VertexPairs& edges, const View<Points>& points);

}  // namespace fairing
