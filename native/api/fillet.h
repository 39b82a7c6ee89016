// A mesh cut around its seams, for a surface that rounds them.
#pragma once

#include "base/progress.h"
#include "fillet/eaten_parts.h"

namespace fairing {

struct FilletInput {
    Points vertices;
    Triangles triangles;
    std::vector<VertexPair> seams;
    std::vector<VertexPair> walls;  // edges that the fillet does not cross
    SeamWidths widths;  // of each vertex, positive; only those on seams are read. Left: the side with the larger part
                        // (fillet/seam_sides)
    bool through =
        false;  // seams that end on an edge of a plane face go on through it (fillet/end_cuts), instead of fading out
    double spacing = 1.0;  // of new edges where the fillet is widest; elsewhere in proportion to its width
};

struct FilletCut {
    SplitMesh mesh;
    Points weights;      // barycentric, of the corners of its triangles in their parents: 3 × (3 × triangles)
    VectorX spacings;    // of new edges at each vertex, old ones first
    Indices boundary;    // vertices where the fillet ends, ascending
    Points normals;      // 3 × of these: unit, of the sides beyond
    VectorX curvatures;  // of these: H in length⁻¹, NaN where not known
    Indices corners;     // boundary vertices where two sides meet: without a normal of their own
    std::vector<EatenPart> eaten;
};

// Throws Cancelled. Preconditions: finite vertices, indices in range, three different ones in each triangle.
FilletCut cut_fillet(const FilletInput& input, const ProgressCallback& progress);

}  // namespace fairing
