// A mesh cut around its seams, for a surface that rounds them.
#pragma once

#include "base/progress.h"
#include "fillet/eaten_parts.h"

namespace fairing {

struct FilletInput {
    Points vertices;
    Triangles triangles;
    std::vector<VertexPair> seams;
    std::vector<VertexPair> walls;  // edges that a fillet does not reach over
    SeamWidths widths;              // of each vertex; those of the seams are read, and are positive: on the left is the
                                    // larger part, as fillet/seam_sides has it
    double spacing = 1.0;           // of the new boundary's vertices, a length
};

struct FilletCut {
    SplitMesh mesh;
    Points weights;      // barycentric, of the corners of its triangles in their parents: 3 × (3 × triangles)
    Indices boundary;    // vertices where the fillet ends, ascending
    Points normals;      // 3 × of these: unit, of the sides beyond
    VectorX curvatures;  // of these: H in length⁻¹, NaN where not known
    Indices corners;     // those of these at which two sides meet, which have no normal of their own
    std::vector<EatenPart> eaten;
};

// Throws Cancelled. Preconditions: finite vertices, indices in range, three different ones in each triangle.
FilletCut cut_fillet(const FilletInput& input, const ProgressCallback& progress);

}  // namespace fairing
