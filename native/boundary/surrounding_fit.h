// Surfaces fitted at the vertices of a boundary to the triangles outside it, and the normals that follow from them.
#pragma once

#include <array>
#include <optional>

#include "geometry/hard_edges.h"
#include "geometry/slope_fit.h"

namespace fairing {

// Edges of a boundary, as places in the list of vertices that were asked for.
using OutlineEdges = std::vector<std::array<int, 2>>;

struct SurroundingFit {
    std::vector<std::optional<SlopeFit>> fits;  // of each vertex asked for, in units of `size`
    Points centres;                             // 3 × k, likewise
    Points averaged;                            // 3 × k: unit mean normals of the adjacent triangles, zero without any
    VectorX lengths;                            // k: mean lengths of the adjacent edges, likewise; zero without any
    Indices first;                              // k: the first place of the same vertex
    OutlineEdges edges;                         // border edges between first places, each once
    double size = 1.0;                          // of the coordinates
};

// The same without fits and averaged normals yet.
SurroundingFit blank_fit(const Points& points, const Triangles& triangles, const Indices& vertices, double size);

// Fits with free centres, from one side of each hard edge (SidedFits); `creases` are hard edges, too.
SurroundingFit fit_surroundings(const Points& points, const Triangles& triangles, const Indices& vertices,
                                const VertexPairs& creases = {});

// Radians: a fit with a larger standard error says little about the surface.
inline constexpr double most_error = 0.15;

struct SurroundingNormals {
    Points normals;            // 3 × k, unit; zero where there is no triangle
    std::vector<char> fitted;  // 0: averaged, for want of points
    VectorX errors;            // k, radians: standard errors of the fits; infinite where not fitted
    VectorX curvatures;        // k, length⁻¹: H (eq. 8); NaN where not fitted
    VectorX curvature_errors;  // k: their standard errors; infinite where not fitted
};

// Normals at `vertices` of the surface formed by `triangles` alone (the surroundings of a patch), filtered along the
// boundary.
SurroundingNormals surrounding_normals(const Points& points, const Triangles& triangles, const Indices& vertices,
                                       const VertexPairs& creases = {});
SurroundingNormals normals_of(const SurroundingFit& fit);

}  // namespace fairing
