// Normals along the boundary of a patch, from the triangles outside or, along hard edges, from its own.
#pragma once

#include "boundary/surrounding_fit.h"
#include "boundary/walls.h"

namespace fairing {

enum class SideRule { automatic, inside };

// A patch and the triangles around it, both as indices into `points`.
struct Surroundings {
    const Points& points;
    const Triangles& patch;
    const Triangles& outside;
};

struct BoundaryNormals {
    SurroundingNormals normals;
    std::vector<char> from_inside;  // of each vertex: the slope is the patch's own or the film's, not the outside's
};

// At `vertices`, which don't move. `automatic`: along walls (walls_of) the slope is that of the patch's own triangles
// where these are clean, else that of a film over the boundary. `inside`: all boundary edges take that of the patch's
// own triangles. A vertex between edges of both kinds, or on no boundary edge, takes the slope outside.
BoundaryNormals boundary_normals(const Surroundings& mesh, const Indices& vertices, const VertexPairs& creases,
                                 SideRule rule);

}  // namespace fairing
