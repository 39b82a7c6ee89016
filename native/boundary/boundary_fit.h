// Normals along the boundary of a patch, from the triangles outside or, along hard edges, from its own.
#pragma once

#include "boundary/hard_boundary.h"
#include "boundary/surrounding_fit.h"

namespace fairing {

// Radians: the largest standard error with which a side of a hard edge is known. A top with noise of .1 edges has .03.
// The walls of a dent that ends in a jagged outline have .05 and more, and so have faces stretched by a part that was
// moved aside.
inline constexpr double most_error = 0.04;

enum class SideRule { automatic, inside };

// Any triangles of the same vertices.
struct Surroundings {
    const Points& points;
    const Triangles& patch;
    const Triangles& outside;
};

struct BoundaryNormals {
    SurroundingNormals normals;
    std::vector<char> from_inside;  // of each vertex
};

// At `vertices`, which don't move. `automatic`: inward_edges take the slope of the patch's own triangles, as far as
// these agree on a surface: where the median standard error along such edges is .04 rad at most. `inside`: all outline
// edges do. A vertex between edges of both kinds takes the slope outside. One that is on no outline edge, too.
BoundaryNormals boundary_normals(const Surroundings& mesh, const Indices& vertices, const VertexPairs& creases,
                                 SideRule rule);

}  // namespace fairing
