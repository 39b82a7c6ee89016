// The caller's mesh, checked and turned into patches.
#pragma once

#include "base/types.h"
#include "geometry/hard_edges.h"
#include "mesh/patch.h"

namespace fairing {

// Stored for some vertices of a mesh only, to save memory on a large one.
class FixedNormals {
public:
    FixedNormals() = default;
    // The columns of `all` at the vertices marked.
    FixedNormals(const std::vector<char>& marks, const Points& all) {
        for (std::size_t v = 0; v < marks.size(); ++v) {
            if (marks[v]) vertices_.push_back(static_cast<int>(v));
        }
        normals_ = all(Eigen::all, vertices_);
    }

    // Precondition, here and below: marked vertices.
    [[nodiscard]] Points::ConstColXpr operator()(int vertex) const { return normals_.col(column(vertex)); }
    [[nodiscard]] Points::ColXpr operator()(int vertex) { return normals_.col(column(vertex)); }
    // 3 × vertices
    [[nodiscard]] Points gather(std::span<const int> vertices) const {
        Points result(3, static_cast<Eigen::Index>(vertices.size()));
        for (std::size_t k = 0; k < vertices.size(); ++k)
            result.col(static_cast<Eigen::Index>(k)) = (*this)(vertices[k]);
        return result;
    }

private:
    [[nodiscard]] Eigen::Index column(int vertex) const {
        return std::ranges::lower_bound(vertices_, vertex) - vertices_.begin();
    }

    Indices vertices_;  // ascending
    Points normals_;
};

// Fixed vertices at which the surface finds its own slope; normals there are ignored.
struct HeldInside {
    Indices creases;           // fixed vertices; curves of them are cut, and each side has a slope of its own
    Indices smooth_curves;     // fixed vertices; curves of them are not cut
    bool fair_border = false;  // border vertices that are not in `fixed` become a fair curve
};

struct MeshInput {
    View<Points> vertices;  // outlive the input
    Triangles triangles;
    std::optional<Indices> fixed;                  // left out: the mesh border
    std::optional<Points> fixed_normals;           // 3 × |fixed|
    std::optional<VectorX> fixed_curvatures = {};  // H at `fixed`, NaN where it is not known, ∞: tangent
    Triangles outside = {};                        // around the patches; they stay
    HeldInside held = {};
    VertexPairs taken = {};  // fixed vertices that are joined outside: a new mesh has no such edge
};

// What follows from the connectivity and the fixed vertices alone. Border vertices are fixed, given or not.
struct MeshTopology {
    VertexRoles roles;
    Indices fixed;  // given order first, then the border vertices that were not given, ascending
    CutMesh cut;
    Diagnostics topology_warnings;
};

// The mesh after all checks.
struct CheckedMesh : MeshTopology {
    FixedNormals normals;  // prescribed unit normals, at `roles.fixed`
    VectorX curvatures;    // prescribed H of each vertex, NaN elsewhere; empty where none are prescribed
    Diagnostics warnings;  // of the geometry
};

// Throws MeshError: INDEX_RANGE, NONFINITE (triangles between fixed vertices may have such corners: they are left out),
// NONMANIFOLD_EDGE, NONMANIFOLD_VERTEX, NOT_ORIENTABLE, ZERO_NORMAL; std::invalid_argument for a fixed vertex named
// twice, for creases and smooth curves of vertices that are not fixed, or that are both.
CheckedMesh check_mesh(const MeshInput& input);

// The two halves of it. The topology stays the same for other positions and normals as long as all are finite.
MeshTopology check_topology(const MeshInput& input);
// Reads positions and normals anew.
void check_geometry(const MeshInput& input, CheckedMesh& mesh);

}  // namespace fairing
