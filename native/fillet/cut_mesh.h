// A mesh cut along the line where a fillet ends.
#pragma once

#include "fillet/level_line.h"

namespace fairing {

struct SplitMesh {
    Points points;                  // new ones, on the line
    Triangles triangles;            // all of the mesh, in its order; cut ones are replaced by their pieces
    Indices parent;                 // of each: the triangle of the mesh that it is, or a piece of
    std::vector<char> inside;       // of each: whether it is within the fillet
    std::vector<VertexPair> seams;  // edges of the seams and walls, parted by the points on them
    std::vector<VertexPair> line;   // edges of the line, the fillet on their left; numbers as in `triangles`
};

// Numbers of new points follow those of the mesh's vertices.
SplitMesh cut_along(const SeamMesh& mesh, const SeamDistance& distance, const LevelLine& line);

}  // namespace fairing
