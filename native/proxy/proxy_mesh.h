// The proxy mesh of a patch: the same boundary, an interior of its own, well-shaped whatever it came from.
#pragma once

#include "mesh/surface_mesh.h"

namespace fairing {

// A vertex that a collapse removed, with the ring that it left behind.
struct RemovedVertex {
    int vertex;
    Indices ring;
};

// Edge lengths of the interior. They begin with the boundary's own spacing and grow by `growth` per distance up to
// `longest`. The normal turns by `turn` radians at most along an edge, down to a quarter of `longest`, so that a narrow
// pipe keeps its shape. No edge is split beyond `free_limit` free vertices.
struct Sizing {
    double growth;
    double longest;
    int free_limit;
    double turn = std::numeric_limits<double>::infinity();
    // No collapse makes an edge that would be split again (Botsch & Kobbelt 2004): then four rounds are enough where
    // twelve would not end. Proxies of harmonic surfaces go without it: deep caps lose their surface on a mesh that
    // changes less.
    bool converges = false;
};

// Vertices keep their number through all changes: those of the patch it was made from first, then vertices that were
// inserted. Fixed vertices and border edges never change. Deterministic.
class ProxyMesh {
public:
    // `points`: 3 × vertices of the patch.
    ProxyMesh(const Patch& patch, const Points& points);

    // Up to `rounds` of flips towards Delaunay (cot α + cot β ≥ 0) that neither fold the surface nor join two fixed
    // vertices, then `sweeps` half-steps of tangential uniform smoothing of the free vertices.
    void remesh(int rounds, int sweeps);

    // Brings edges towards the local length: half-edge collapses of free vertices where they are shorter than 0.7 of
    // it, splits where they are longer than 4/3, flips and smoothing in between, until little changes. Topology-safe.
    void adapt(const Sizing& sizing);

    // The vertices that collapses removed, in this order.
    [[nodiscard]] const std::vector<RemovedVertex>& removed() const { return removed_; }

    // Count of all vertex numbers ever used.
    [[nodiscard]] int number_count() const { return static_cast<int>(fixed_.size()); }

    // A patch of the present connectivity with the numbers of its vertices; read_back takes its positions.
    struct Snapshot {
        Patch patch;  // to_input holds the vertex numbers of this mesh
        Points points;
    };
    [[nodiscard]] Snapshot snapshot() const;
    void read_back(const Patch& patch, const Points& points);

    [[nodiscard]] int free_count() const { return free_count_; }

private:
    using Vertex = SurfaceMesh::VertexHandle;
    using Halfedge = SurfaceMesh::HalfedgeHandle;
    using Edge = SurfaceMesh::EdgeHandle;

    // Which collapses are refused: those that make poor triangles, or edges that would be split again.
    struct Care {
        bool for_shapes = false;
        bool for_lengths = false;
    };

    [[nodiscard]] bool fixed(Vertex v) const { return fixed_[static_cast<std::size_t>(v.idx())] != 0; }
    [[nodiscard]] Vector3 point(Vertex v) const { return mesh_.point(v); }
    [[nodiscard]] bool should_flip(Edge e) const;
    int flip_round();
    void smooth();
    int collapse_short(const VectorX& target, const Care& care);
    int split_long(const VectorX& target, int free_limit);
    [[nodiscard]] double relative_length(Halfedge h, const VectorX& target) const;
    [[nodiscard]] bool may_collapse(Halfedge h);
    [[nodiscard]] bool makes_long(Halfedge h, const VectorX& target) const;
    void collapse(Halfedge h);
    [[nodiscard]] bool keeps_shape(Halfedge h) const;
    [[nodiscard]] Vector3 normal(Vertex v) const;
    [[nodiscard]] VectorX lengths_by_turn(const Sizing& sizing) const;
    [[nodiscard]] VectorX target_lengths(const Sizing& sizing) const;

    SurfaceMesh mesh_;
    std::vector<char> fixed_;
    std::vector<char> pin_;
    int free_count_;
    std::vector<RemovedVertex> removed_;
};

}  // namespace fairing
