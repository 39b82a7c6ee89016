// Quads in rows over a fillet: strips along its seams, blocks where they meet, caps where they fade out.
#pragma once

#include "fillet/row_line.h"

namespace fairing {

using Quad = std::array<int, 4>;

struct RowMesh {
    std::vector<Quad> quads;  // of the mesh's vertices, the line's new points, and new vertices,
    struct Place {
        int triangle;  // which have these places on the mesh
        Vector3 weights;
        bool on_seam;
    };
    std::vector<Place> places;
};

// Where a place on the mesh is on the fillet.
using Carried = std::function<Vector3(const Vector3&)>;

// As many rows across each side as spacings go into the width. Numbers the line. Throws NoRows.
RowMesh row_mesh(const SeamMesh& mesh, const SeamWalks& walks, const RowStrips& strips, const RowSizes& sizes,
                 const Carried& carried, RowLine& line);

}  // namespace fairing
