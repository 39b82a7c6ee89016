#include "mesh/renumbered.h"

#include "base/order.h"

namespace fairing {

namespace {

using Vertex = SurfaceMesh::VertexHandle;
using Halfedge = SurfaceMesh::HalfedgeHandle;
using Edge = SurfaceMesh::EdgeHandle;
using Face = SurfaceMesh::FaceHandle;

class Renumbered {
public:
    Renumbered(const SurfaceMesh& mesh, const Indices& vertices, const Indices& edges)
        : old_(mesh),
          vertex_number_(places_in(vertices, mesh.n_vertices())),
          edge_number_(places_in(edges, mesh.n_edges())),
          face_number_(mesh.n_faces(), none) {
        new_.request_vertex_status();
        new_.request_edge_status();
        new_.request_halfedge_status();
        new_.request_face_status();
        new_.reserve(vertices.size(), edges.size(), mesh.n_faces());
        for (const int v : vertices) add(Vertex(v));
        for (const int e : edges) add(Edge(e));
        for (const int e : edges) {
            if (!mesh.status(Edge(e)).deleted()) connect(Edge(e));
        }
        for (const int v : vertices) {
            if (!mesh.status(Vertex(v)).deleted()) new_.set_halfedge_handle(moved(Vertex(v)), moved(out_of(Vertex(v))));
        }
    }
    SurfaceMesh take() { return std::move(new_); }

private:
    [[nodiscard]] Halfedge out_of(Vertex v) const { return old_.halfedge_handle(v); }
    [[nodiscard]] Vertex moved(Vertex v) const { return Vertex(vertex_number_[v.idx()]); }
    [[nodiscard]] Halfedge moved(Halfedge h) const { return Halfedge(2 * edge_number_[h.idx() / 2] + h.idx() % 2); }

    void add(Vertex v) {
        const Vertex added = new_.new_vertex();
        new_.set_point(added, old_.point(v));
        new_.status(added) = old_.status(v);
    }

    void add(Edge e) {
        const Halfedge h = old_.halfedge_handle(e, 0);
        const bool gone = old_.status(e).deleted();
        const Vertex from = gone ? Vertex(0) : moved(old_.from_vertex_handle(h));
        const Vertex to = gone ? Vertex(1) : moved(old_.to_vertex_handle(h));
        const Halfedge added = new_.new_edge(from, to);
        new_.status(new_.edge_handle(added)) = old_.status(e);
        for (const unsigned side : {0U, 1U})
            new_.status(new_.halfedge_handle(new_.edge_handle(added), side)) =
                old_.status(old_.halfedge_handle(e, side));
    }

    void connect(Edge e) {
        for (const unsigned side : {0U, 1U}) {
            const Halfedge h = old_.halfedge_handle(e, side);
            new_.set_next_halfedge_handle(moved(h), moved(old_.next_halfedge_handle(h)));
            if (old_.is_boundary(h)) {
                new_.set_boundary(moved(h));
            } else {
                new_.set_face_handle(moved(h), moved(old_.face_handle(h)));
            }
        }
    }

    // Made where it is first met.
    Face moved(Face f) {
        int& number = face_number_[f.idx()];
        if (number != none) return Face(number);
        const Face added = new_.new_face();
        new_.set_halfedge_handle(added, moved(old_.halfedge_handle(f)));
        number = added.idx();
        return added;
    }

    const SurfaceMesh& old_;
    SurfaceMesh new_;
    Indices vertex_number_;
    Indices edge_number_;
    Indices face_number_;
};

}  // namespace

SurfaceMesh renumbered(const SurfaceMesh& mesh, const Indices& vertices, const Indices& edges) {
    return Renumbered(mesh, vertices, edges).take();
}

}  // namespace fairing
