#include "mesh/patch.h"

#include <algorithm>

namespace fairing {

namespace {

bool has_free_vertex(const CutMesh& mesh, const Indices& piece_triangles, const VertexRoles& roles) {
    return std::any_of(piece_triangles.begin(), piece_triangles.end(), [&](int t) {
        const auto corners = mesh.triangles.col(t);
        return std::any_of(corners.begin(), corners.end(),
                           [&](int v) { return !roles.fixed[at(mesh.input_vertex[at(v)])]; });
    });
}

// Free vertices first, each group in the order of the input, so that neighbours in the input stay close in memory.
PatchMembers number_vertices(const CutMesh& cut, const Indices& piece_triangles, const VertexRoles& roles) {
    PatchMembers members;
    Indices vertices;
    for (int t : piece_triangles)
        vertices.insert(vertices.end(), cut.triangles.col(t).begin(), cut.triangles.col(t).end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const auto input = [&](int v) { return cut.input_vertex[at(v)]; };
    std::sort(vertices.begin(), vertices.end(),
              [&](int a, int b) { return input(a) != input(b) ? input(a) < input(b) : a < b; });
    const auto first_fixed =
        std::stable_partition(vertices.begin(), vertices.end(), [&](int v) { return !roles.fixed[at(input(v))]; });
    members.free_count = static_cast<int>(first_fixed - vertices.begin());

    Indices local(cut.input_vertex.size(), none);
    for (int v : vertices) {
        local[at(v)] = static_cast<int>(members.to_input.size());
        members.to_input.push_back(input(v));
        members.pin.push_back(roles.pin[at(input(v))]);
    }
    members.triangles.resize(3, static_cast<Eigen::Index>(piece_triangles.size()));
    for (std::size_t k = 0; k < piece_triangles.size(); ++k) {
        const int t = piece_triangles[k];
        members.input_triangle.push_back(cut.input_triangle[at(t)]);
        for (int c = 0; c < 3; ++c) members.triangles(c, static_cast<Eigen::Index>(k)) = local[at(cut.triangles(c, t))];
    }
    return members;
}

}  // namespace

Patch::Patch(PatchMembers members) : PatchMembers(std::move(members)) {
    build_mesh();
    flatten_edges();
    flatten_rings();
}

RingView Patch::ring(int vertex) const {
    const auto view = [vertex](const Indices& begin, const Indices& items) {
        const auto first = at(begin[at(vertex)]);
        return std::span<const int>(items.data() + first, at(begin[at(vertex) + 1]) - first);
    };
    return {view(ring_begin_, ring_vertices_), view(ring_begin_, ring_spokes_), view(rim_begin_, ring_rim_)};
}

int Patch::loop_count() const {
    std::vector<char> seen(mesh.n_halfedges(), 0);
    int loops = 0;
    for (const SurfaceMesh::HalfedgeHandle start : mesh.halfedges()) {
        if (!mesh.is_boundary(start) || seen[at(start.idx())]) continue;
        ++loops;
        for (SurfaceMesh::HalfedgeHandle h = start; !seen[at(h.idx())]; h = mesh.next_halfedge_handle(h)) {
            seen[at(h.idx())] = 1;
        }
    }
    return loops;
}

void Patch::build_mesh() {
    const auto vertices = to_input.size();
    mesh.reserve(vertices, vertices + at(triangle_count()) + 64, at(triangle_count()));
    for (std::size_t v = 0; v < vertices; ++v) mesh.add_vertex(SurfaceMesh::Point::Zero());
    for (int t = 0; t < triangle_count(); ++t) {
        const auto corner = [&](int k) { return mesh.vertex_handle(static_cast<unsigned>(triangles(k, t))); };
        if (!mesh.add_face(corner(0), corner(1), corner(2)).is_valid()) {
            throw MeshError({Code::nonmanifold_edge,
                             "triangle " + std::to_string(input_triangle[at(t)]) + " can't be joined to its neighbours",
                             {to_input[at(triangles(0, t))], to_input[at(triangles(1, t))]}});
        }
    }
}

void Patch::flatten_edges() {
    const auto face = [&](SurfaceMesh::HalfedgeHandle h) {
        return mesh.is_boundary(h) ? none : mesh.face_handle(h).idx();
    };
    triangle_edges.resize(3, triangle_count());
    edge_ends.reserve(mesh.n_edges());
    edge_triangles.reserve(mesh.n_edges());
    for (const SurfaceMesh::EdgeHandle edge : mesh.edges()) {
        SurfaceMesh::HalfedgeHandle h = mesh.halfedge_handle(edge, 0);
        if (mesh.is_boundary(h)) h = mesh.opposite_halfedge_handle(h);
        edge_ends.push_back({mesh.from_vertex_handle(h).idx(), mesh.to_vertex_handle(h).idx()});
        edge_triangles.push_back({face(h), face(mesh.opposite_halfedge_handle(h))});
        for (int t : edge_triangles.back()) {
            if (t == none) continue;
            for (int k = 0; k < 3; ++k) {
                const int v = triangles(k, t);
                if (v != edge_ends.back()[0] && v != edge_ends.back()[1]) triangle_edges(k, t) = edge.idx();
            }
        }
    }
}

void Patch::flatten_rings() {
    ring_begin_ = {0};
    rim_begin_ = {0};
    ring_vertices_.reserve(2 * mesh.n_edges());
    ring_spokes_.reserve(2 * mesh.n_edges());
    ring_rim_.reserve(2 * mesh.n_edges());
    const auto next_ccw = [&](SurfaceMesh::HalfedgeHandle h) {
        return mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h));
    };
    for (const SurfaceMesh::VertexHandle vertex : mesh.vertices()) {
        // OpenMesh keeps the outgoing border half-edge first; the fan begins one step after it.
        SurfaceMesh::HalfedgeHandle first = mesh.halfedge_handle(vertex);
        if (mesh.is_boundary(first)) first = next_ccw(first);
        SurfaceMesh::HalfedgeHandle h = first;
        do {
            ring_vertices_.push_back(mesh.to_vertex_handle(h).idx());
            ring_spokes_.push_back(mesh.edge_handle(h).idx());
            if (mesh.is_boundary(h)) break;
            ring_rim_.push_back(mesh.edge_handle(mesh.next_halfedge_handle(h)).idx());
            h = next_ccw(h);
        } while (h != first);
        ring_begin_.push_back(static_cast<int>(ring_vertices_.size()));
        rim_begin_.push_back(static_cast<int>(ring_rim_.size()));
    }
}

std::vector<Indices> triangles_of_pieces(const CutMesh& mesh) {
    std::vector<Indices> pieces(at(mesh.piece_count));
    for (std::size_t t = 0; t < mesh.piece.size(); ++t) pieces[at(mesh.piece[t])].push_back(static_cast<int>(t));
    return pieces;
}

Patch make_patch(const CutMesh& cut, const Indices& piece_triangles, const VertexRoles& roles) {
    return Patch(number_vertices(cut, piece_triangles, roles));
}

std::vector<Patch> make_patches(const CutMesh& mesh, const VertexRoles& roles) {
    std::vector<Patch> patches;
    for (const Indices& piece : triangles_of_pieces(mesh)) {
        if (has_free_vertex(mesh, piece, roles)) patches.push_back(make_patch(mesh, piece, roles));
    }
    return patches;
}

}  // namespace fairing
