// How long the edges of a new mesh are to be.
#pragma once

#include <set>

#include "mesh/patch.h"

namespace fairing {

// Vertices of a mesh of equilateral triangles per square of its edge: 2 / √3.
inline constexpr double vertices_per_square = 1.1547;

// In proportion to the boundary's own edges, harmonic in between, or the same everywhere.
enum class Spread { boundary, equal };

struct WantedLengths {
    double spacing = 0.0;  // of an edge in the mean of the boundary's; 0: as these are
    int least_count = 0;   // about so many vertices at least: lengths shrink evenly until they give that many
    Spread spread = Spread::boundary;
    VectorX each = {};  // with equal spread, of each vertex in place of the spacing
    bool flat = false;  // the old triangles are the surface as they are; small angles that smoothing leaves stay
};

// One entry for each edge of a patch: whether the new mesh has it, too. Border edges stay anyway; empty: no others.
using KeptEdges = std::vector<char>;
using EdgeSet = std::set<std::array<int, 2>>;  // smaller number first

// A length at each vertex of a patch (`points`: 3 × local vertices). At edges that stay it is that of these; from there
// it grows or shrinks to the wanted one by a half of the distance; by all of it, or by twice as much, where the edges
// that stay are so long that few vertices would be left.
VectorX edge_lengths(const Patch& patch, const Points& points, const WantedLengths& wanted, const KeptEdges& kept = {});

// How many vertices a mesh of equilateral triangles of these lengths has on the patch, about.
double expected_count(const Patch& patch, const Points& points, const VectorX& lengths);

}  // namespace fairing
