// A mesh cut around its seams, for a surface that rounds them.
#pragma once

#include <optional>

#include "base/progress.h"
#include "fillet/cut_mesh.h"

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
    Indices swallowed;   // vertices of parts that the seams bound and of which nothing would be left
};

// A wall's edge that the fillet reaches, as a half-edge.
struct ReachedWall {
    int edge;  // its number
    int tail, head;
    int triangle, corner;  // the half-edge begins at that corner
};

// Where a fillet ends, and from where on the seam that is reached.
struct FilletLine {
    LevelLine line;  // about half a spacing from point to point
    struct Foot {
        VertexPair half_edge;  // tail and head, or `none`
        bool corner;           // as SeamFoot has it
        double along;
    };
    std::vector<Foot> feet;        // of its points
    std::vector<VertexPair> ends;  // of the edges that its points are on, or `none`
    std::vector<VertexPair> seams;
    std::vector<ReachedWall> walls;
};

// Both throw Cancelled. Preconditions: finite vertices, indices in range, three different ones in each triangle.
FilletLine fillet_line(const FilletInput& input, const ProgressCallback& progress);
// Along a line with points that suit a mesh of triangles, or along the one given, which passes the triangles' sides
// where that of `fillet_line` does and needs no weights.
FilletCut cut_fillet(const FilletInput& input, const std::optional<LevelLine>& line, const ProgressCallback& progress);

}  // namespace fairing
