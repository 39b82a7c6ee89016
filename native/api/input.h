// The caller's mesh, checked and turned into patches.
#pragma once

#include <optional>

#include "mesh/patch.h"

namespace fairing {

struct MeshInput {
    Points vertices;
    Triangles triangles;
    std::optional<Indices> fixed;         // left out: the mesh border
    std::optional<Points> fixed_normals;  // 3 × |fixed|
};

// The mesh after all checks. Border vertices are fixed, given or not.
struct CheckedMesh {
    VertexRoles roles;
    Indices fixed;   // given order first, then the border vertices that were not given, ascending
    Points normals;  // 3 × vertices: prescribed unit normals at fixed vertices, zero elsewhere
    CutMesh cut;
    Diagnostics warnings;
};

// Throws MeshError: INDEX_RANGE, NONFINITE (triangles between fixed vertices may have such corners: they are left out),
// NONMANIFOLD_EDGE, NONMANIFOLD_VERTEX, NOT_ORIENTABLE; std::invalid_argument for a fixed vertex named twice or a
// normal of length zero.
CheckedMesh check_mesh(const MeshInput& input);

}  // namespace fairing
