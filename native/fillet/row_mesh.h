// Quads in rows over a fillet of triangles: each band by itself, and the corners at which all bands have rows.
#pragma once

#include "fillet/row_strip.h"

namespace fairing {

struct RowMesh {
    std::vector<Quad> quads;                 // of the surface's vertices and new ones
    std::vector<Eigen::Vector3i> triangles;  // where rows end
    std::vector<VertexPair> ends;            // edges of the surface where its triangles go on
};

// Adds vertices to the surface. `must`: of each vertex of its border, whether an edge outside needs it.
RowMesh row_mesh(const SeamMesh& mesh, const Bands& bands, const std::vector<char>& must, int rows,
                 RowSurface& surface);

}  // namespace fairing
