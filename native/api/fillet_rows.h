// Quads in rows along the seams of a fillet.
#pragma once

#include "api/fillet.h"

namespace fairing {

// A fillet's surface, solved on triangles within the pieces of a cut. Vertices are numbered: the mesh's, then the cut's
// points, then new ones.
struct FilletSurface {
    Points vertices;
    Triangles triangles;
    Indices fixed;
    Points normals;            // 3 × fixed
    Points before;             // where each vertex was on the mesh
    std::vector<char> inside;  // of the cut's pieces: whether they are within it
};

struct WantedRows {
    double spacing;                                  // about the length of edges across the seams
    std::optional<std::vector<VertexPair>> counted;  // edges of the mesh that are no diagonals: the others get no
                                                     // vertices. Default: all
};

struct FilletRows {
    FilletCut cut;                          // without points of the cut line that no quad uses
    std::vector<std::array<int, 4>> quads;  // of the surface's vertices, and of new ones, which follow:
    Triangles triangles;                    // beside the quads, and those of the surface that stay
    Points places;                          // the new ones on the surface,
    Indices solved;                         // the triangles of the surface that they lie on,
    Points on_solved;                       // and their weights there;
    Indices given;                          // the triangles of the mesh beneath them,
    Points on_given;                        // and their weights there;
    std::vector<char> on_seam;              // whether they lie on a seam
};

// None where no rows fit. `input`: as for the cut. Throws Cancelled, and what check_mesh throws of the surface.
std::optional<FilletRows> fillet_rows(const FilletInput& input, const WantedRows& wanted, const FilletSurface& surface,
                                      const ProgressCallback& progress);

}  // namespace fairing
