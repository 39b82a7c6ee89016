// Quads in rows along the seams of a fillet.
#pragma once

#include "api/fillet.h"
#include "fillet/row_mesh.h"

namespace fairing {

// A fillet's surface, solved on triangles.
struct SolvedFillet {
    Points vertices;
    Triangles triangles;
    Indices fixed;
    Points normals;  // 3 × fixed
    Points before;   // where each vertex was on the mesh
};

struct WantedRows {
    double spacing;                                  // about the length of edges across the seams
    std::optional<std::vector<VertexPair>> counted;  // edges of the mesh that are no diagonals: the others get no
                                                     // vertices. Default: all
};

struct FilletRows {
    FilletCut cut;              // along the quads' border
    std::vector<Quad> quads;    // of the mesh's vertices, the cut's points, and new ones:
    Points places;              // these, on the surface,
    Indices solved;             // the triangles of the surface that they lie on,
    Points on_solved;           // and their weights there;
    Indices given;              // the triangles of the mesh beneath them,
    Points on_given;            // and their weights there;
    std::vector<char> on_seam;  // whether they lie on a seam
};

// None where no rows fit. Throws Cancelled, and what check_mesh throws of the surface.
std::optional<FilletRows> fillet_rows(const FilletInput& input, const WantedRows& wanted, const SolvedFillet& surface,
                                      const ProgressCallback& progress);

}  // namespace fairing
