// Surfaces over the holes of a mesh, and between boundary loops. Each is a job of its own: what comes out does not
// depend on which others are filled, nor on the number of threads.
#pragma once

#include "api/fair.h"
#include "api/holes.h"
#include "fill/edge_lengths.h"

namespace fairing {

struct FillOptions {
    FairOptions fair;              // creases and smooth curves are named in `held`
    HeldInside held = {};          // vertices of the boundary
    bool joins_curvature = false;  // G2: the curvature around goes on, too
    bool bridge = false;           // one surface joins all loops
    bool in_rows = false;          // quads in rows, each as two triangles
    double spacing = 0.0;          // of new edges away from the boundary; 0: as long as its own
    Spread spread = Spread::boundary;
    int max_vertices =
        0;  // more are refused; 0: 20 times those of a flat surface, at least 50,000 and at most 4,000,000
};

// Curves that run through a hole, as creases of a surface of least variation. Numbers from the mesh's count on are
// those of `added`.
struct CurvesThrough {
    Points added;
    std::vector<Indices> loops;  // the hole's loop, cut along the curves, the surface on the left
    std::vector<Points> normals;
    Indices creases;    // all vertices of curves
    VertexPairs edges;  // that no quad runs across
};

struct FilledHole {
    std::vector<Indices> loops;                   // vertices of the mesh, the surface on the left
    std::optional<Diagnostic> left_because = {};  // why it stays open; then all that follows is empty
    Points vertices = {};                         // the new ones, those on curves first,
    Triangles triangles = {};                     // numbered after all vertices of the mesh
    FairResult report = {};  // `vertices` and `base` are empty; elements of warnings are numbered likewise
    bool is_cut = false;     // from another mesh's surface
    bool along_curves = false;
    std::optional<VertexPairs> pairs = {};  // `in_rows`: the triangles of each quad
};

// In the order of the holes. `through`: for each hole, or empty. Throws the first reason where none can be filled;
// Cancelled, MemoryShortage, std::invalid_argument.
std::vector<FilledHole> fill(const HoledMesh& mesh, const std::vector<Hole>& holes,
                             const std::vector<std::optional<CurvesThrough>>& through, const FillOptions& options,
                             const ProgressCallback& progress);

}  // namespace fairing
