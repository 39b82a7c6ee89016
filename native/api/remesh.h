// New meshes for existing surfaces.
#pragma once

#include "api/fair.h"
#include "fill/edge_lengths.h"
#include "geometry/hard_edges.h"

namespace fairing {

struct NewMesh {
    Points vertices;      // new ones
    Points normals;       // of the surface there, unit
    Triangles triangles;  // numbers below the count of old vertices are those, the others new ones
    Indices triangle;     // of the old mesh, for each new vertex,
    Points weights;       // and its barycentric coordinates there
    Indices old;          // the old vertex that it is, one at a kept edge, or `none`
};

// A new mesh for the surface of the old one, whose fixed and border vertices stay, and the edges `kept` with the
// vertices there. Vertices lie on curved triangles (geometry/target_surface) over the old ones. `wanted.least_count`
// holds for each component. Components without free vertices stay as they are. Throws what check_mesh throws, and
// NO_FREE_VERTICES.
NewMesh remesh(const MeshInput& input, const VertexPairs& kept, const WantedLengths& wanted, int threads,
               const ProgressCallback& progress);

// About how many vertices that mesh would have.
double expected_remesh_count(const MeshInput& input, const WantedLengths& wanted);

}  // namespace fairing
