// The hierarchy of a whole mesh.
#pragma once

#include "api/input.h"

namespace fairing {

// One level in the input's own vertex numbers.
struct MeshLevel {
    Indices vertices;     // ascending: those that its triangles use
    Triangles triangles;  // wound as the cut mesh is
};

// The levels that method "paper" works on, coarse to fine; the last one is the mesh itself. Fixed and border vertices
// are on every level. Components without free vertices stay whole; those with fewer levels stay at their coarsest.
// Throws what check_mesh throws.
std::vector<MeshLevel> mesh_hierarchy(const MeshInput& input, int levels);

}  // namespace fairing
