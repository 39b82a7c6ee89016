// A mesh of nearly equilateral triangles on a surface that is known.
#pragma once

#include "fill/edge_lengths.h"
#include "geometry/flips.h"
#include "geometry/target_surface.h"
#include "mesh/surface_mesh.h"

namespace fairing {

// Begins as the triangles of the surface's own patch, whose fixed vertices, border edges and kept edges stay. The other
// vertices come, go and slide on the surface until the edges are as long as wanted. Deterministic.
class EqualEdgeMesh {
public:
    // Needs one free vertex. `lengths`: wanted at the vertices of `patch`. `taken`: pairs of fixed vertices, counted
    // from the first of these, that are joined outside. Keeps references.
    EqualEdgeMesh(const Patch& patch, const Points& points, const TargetSurface& surface, const VectorX& lengths,
                  KeptEdges kept = {}, EdgeSet taken = {});
    // Splits, collapses, flips and smooths. Asks whether to stop.
    void equalise();
    // Splits edges and takes vertices out where angles below 26° stay otherwise, worst first: the smallest grow at the
    // cost of others. Asks whether to stop.
    void repair_angles();
    // Splits edges between fixed vertices, at which a patch would end, but for those at sharp corners. Returns how
    // many.
    int split_chords();
    // Vertices 0 … k − 1 are free, at these places; then come the patch's fixed vertices in their order.
    struct Result {
        std::vector<SurfacePoint> where;
        Points points;  // 3 × k
        Indices old;    // the free vertex of the patch that each is: one at a kept edge; or `none`
        Triangles triangles;
    };
    [[nodiscard]] Result result() const;

private:
    using Vertex = SurfaceMesh::VertexHandle;
    using Halfedge = SurfaceMesh::HalfedgeHandle;
    using Edge = SurfaceMesh::EdgeHandle;
    using Face = SurfaceMesh::FaceHandle;
    [[nodiscard]] bool fixed(Vertex v) const { return fixed_[v.idx()] != 0; }
    [[nodiscard]] bool fixed_in_patch(Vertex v) const;
    [[nodiscard]] bool stays(Edge e) const { return mesh_.is_boundary(e) || kept_[e.idx()] != 0; }
    [[nodiscard]] Vector3 point(Vertex v) const { return mesh_.point(v); }
    [[nodiscard]] Vertex apex(Halfedge h) const { return mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)); }
    [[nodiscard]] double wanted_between(Vertex one, Vertex other) const;
    [[nodiscard]] double relative_length(Edge e) const;
    [[nodiscard]] bool is_chord(Edge e) const;
    [[nodiscard]] bool cuts_sharp_corner(Edge e) const;
    [[nodiscard]] bool is_sharp_corner(Vertex corner, Vertex a, Vertex b) const;
    void put(Vertex v, const Vector3& position, int triangle);
    [[nodiscard]] int triangle_beside(Edge e) const;
    Vertex split(Edge e);
    int split_long();
    int collapse_short();
    [[nodiscard]] bool makes_long_edges(Halfedge h, double most) const;
    [[nodiscard]] bool may_collapse(Halfedge h);
    [[nodiscard]] bool may_flip(Edge e) const;
    [[nodiscard]] Diagonal diagonal(Edge e) const;
    int flip_edges();
    [[nodiscard]] std::array<Edge, 4> sides_around(Edge e) const;
    void smooth(int sweeps);
    bool improve_flip(Edge e);
    [[nodiscard]] Indices around_small_angles() const;
    void improve();
    [[nodiscard]] std::array<Halfedge, 3> sides(Face f) const;
    // A triangle seen from one of its corners.
    struct Side {
        Vector3 b, c;                // the other two, counter-clockwise
        Vector3 normal;              // of the surface
        std::array<bool, 3> forced;  // whether two edges that stay make the angle: at the corner, at b, at c
        // Its least angle that is not forced if the corner were there; negative where it is turned over. Degrees.
        [[nodiscard]] double free_angle(const Vector3& place) const;
    };
    [[nodiscard]] Side side_of(Halfedge h) const;
    [[nodiscard]] std::vector<Side> star(Vertex v) const;
    [[nodiscard]] double free_angle(Face f) const;
    [[nodiscard]] double penalty(const Indices& vertices) const;
    int relax_place(Vertex v);
    int relax_edges(Vertex v, const Indices& vertices);
    void relax(const Indices& vertices);
    [[nodiscard]] Indices region(Face f) const;
    [[nodiscard]] bool closes_sharp_corner(Vertex a, Vertex b) const;
    [[nodiscard]] bool may_join(Vertex a, Vertex b) const;
    [[nodiscard]] bool may_close(Halfedge h);
    void centre(std::span<const Vertex> vertices);
    int turn_edge(Edge e);
    [[nodiscard]] std::vector<std::function<int(EqualEdgeMesh&)>> remedies(Face f);
    [[nodiscard]] std::vector<Face> bad_faces() const;
    bool repair(Face f);
    const Patch* patch_;
    const Points* points_;
    const TargetSurface* surface_;
    const VectorX* lengths_;
    SurfaceMesh mesh_;
    std::vector<char> fixed_;  // in the patch, or at a kept edge
    KeptEdges kept_;
    EdgeSet taken_;
    std::vector<SurfacePoint> where_;
    std::vector<double> wanted_;
    int free_count_;
    bool worst_counts_ = false;  // among angles that can't all be repaired; otherwise their sum does
};

}  // namespace fairing
