// A patch, faired, on a new mesh.
#pragma once

#include "api/fair.h"
#include "fill/edge_lengths.h"
#include "geometry/hard_edges.h"

namespace fairing {

struct NewPatchOptions {
    FairOptions fair;
    WantedLengths wanted;
    bool in_rows = false;  // quads, each as two triangles
    int max_vertices = 0;  // more new ones are refused; 0: as for fill()
};

struct NewPatch {
    Points vertices;      // new ones
    Triangles triangles;  // numbers from the count of old vertices on are the new ones
    FairResult report;    // `vertices` and `base` are empty, `mean_curvature` is that of the new vertices
    bool is_cut = false;  // from the surface of the old mesh
    Indices triangle;     // of the old mesh, for each new vertex,
    Points weights;       // and its barycentric coordinates there
    Indices old;          // the old vertex it equals, where that lies on a kept edge, or `none`
    std::optional<VertexPairs> pairs = {};  // `in_rows`: the triangles of each quad
};

// The surface of the old mesh, and on it a new one that keeps the fixed vertices, the boundary's edges and those of
// `kept`. A new mesh is solved again unless it is coarser than the old one and small. Throws what fair() and remesh()
// throw, and OUT_OF_PROPORTION.
NewPatch new_patch(const MeshInput& input, const VertexPairs& kept, const NewPatchOptions& options,
                   const ProgressCallback& progress);

}  // namespace fairing
