// Normals along the boundary of a patch, from the triangles outside or, along hard edges, from its own.
#pragma once

#include "boundary/surrounding_fit.h"
#include "boundary/walls.h"

namespace fairing {

enum class SideRule { automatic, inside };

// Any triangles of the same vertices.
struct Surroundings {
    const Points& points;
    const Triangles& patch;
    const Triangles& outside;
};

struct BoundaryNormals {
    SurroundingNormals normals;
    std::vector<char> from_inside;  // of each vertex: not the slope outside
};

// At `vertices`, which don't move. `automatic`: along walls (walls_of) the slope is that of the patch's own triangles
// where these are clean, else that of a film over the boundary. `inside`: all boundary edges take that of the patch's
// own triangles. A vertex between edges of both kinds takes the slope outside. One that is on no boundary edge, too.
BoundaryNormals boundary_normals(const Surroundings& mesh, const Indices& vertices, const VertexPairs& creases,
                                 SideRule rule);

}  // namespace fairing
