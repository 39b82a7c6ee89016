// A start between two outlines that face each other along a bend.
#pragma once

#include <optional>

#include "mesh/patch.h"

namespace fairing {

// New vertices, and triangles over them (first) and the outlines' vertices.
struct TubeMesh {
    Points points;  // 3 × new vertices
    Triangles triangles;
};

// Nothing where `bare`, a patch without free vertices, has other than two loops, or where they don't face along one
// tube. The sections are swept along the cubic that leaves each outline's middle into the gap; in between they are
// blended in frames that don't turn about it (Wang et al. 2008, double reflection). `points`, `normals`: 3 × vertices.
std::optional<TubeMesh> tube_start(const Patch& bare, const Points& points, const Points& normals);

}  // namespace fairing
