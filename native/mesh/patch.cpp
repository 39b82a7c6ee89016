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
    number_edges();
    flatten_rings();
}

RingView Patch::ring(int vertex) const {
    const auto view = [vertex](const Indices& begin, const Indices& items) {
        const auto first = at(begin[at(vertex)]);
        return std::span<const int>(items.data() + first, at(begin[at(vertex) + 1]) - first);
    };
    return {view(ring_begin_, ring_vertices_), view(ring_begin_, ring_spokes_), view(rim_begin_, ring_rim_)};
}

std::vector<Indices> Patch::loops() const {
    std::vector<char> seen(at(vertex_count()), 0);
    std::vector<Indices> result;
    for (int start = free_count; start < vertex_count(); ++start) {
        if (seen[at(start)] || ring(start).closed()) continue;
        Indices& loop = result.emplace_back();
        // The first neighbour of an open ring lies behind the border edge with the patch on its left.
        for (int v = start; !seen[at(v)]; v = ring(v).vertices.front()) {
            seen[at(v)] = 1;
            loop.push_back(v);
        }
    }
    return result;
}

void Patch::refuse(int triangle, int a, int b) const {
    throw MeshError({Code::nonmanifold_edge,
                     "triangle " + std::to_string(input_triangle[at(triangle)]) + " can't be joined to its neighbours",
                     {to_input[at(a)], to_input[at(b)]}});
}

// Edges in the order in which the triangles' sides (0 → 1, 1 → 2, 2 → 0) first show them.
void Patch::number_edges() {
    struct Side {
        int head;
        int edge;
    };
    Indices begin(at(vertex_count()) + 1, 0);
    for (const int v : triangles.reshaped()) ++begin[at(v) + 1];
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    Indices end(begin.begin(), begin.end() - 1);  // sides known so far, by tail
    std::vector<Side> sides(at(3 * triangle_count()));
    const auto find = [&](int tail, int head) {
        for (int s = begin[at(tail)]; s < end[at(tail)]; ++s) {
            if (sides[at(s)].head == head) return sides[at(s)].edge;
        }
        return none;
    };
    triangle_edges.resize(3, triangle_count());
    edge_ends.reserve(at(3 * triangle_count() / 2 + vertex_count() / 8 + 8));
    edge_triangles.reserve(edge_ends.capacity());
    for (int t = 0; t < triangle_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int tail = triangles(k, t);
            const int head = triangles((k + 1) % 3, t);
            int edge = find(head, tail);
            if (edge == none) {
                edge = edge_count();
                edge_ends.push_back({tail, head});
                edge_triangles.push_back({t, none});
            } else {
                edge_triangles[at(edge)][1] = t;
            }
            if (find(tail, head) != none) refuse(t, tail, head);
            sides[at(end[at(tail)]++)] = {head, edge};
            triangle_edges((k + 2) % 3, t) = edge;
        }
    }
}

void Patch::flatten_rings() {
    // A triangle at each vertex; on the border the one with the border edge that begins there.
    Indices first(at(vertex_count()), none);
    Indices triangles_at(at(vertex_count()), 0);
    for (int t = 0; t < triangle_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int v = triangles(k, t);
            ++triangles_at[at(v)];
            const bool begins = edge_triangles[at(triangle_edges((k + 2) % 3, t))][1] == none;
            if (first[at(v)] == none || begins) first[at(v)] = t;
        }
    }
    ring_begin_ = {0};
    rim_begin_ = {0};
    for (Indices* list : {&ring_vertices_, &ring_spokes_, &ring_rim_}) list->reserve(2 * edge_ends.size());
    for (int v = 0; v < vertex_count(); ++v) {
        int passed = 0;
        for (int t = first[at(v)]; t != none;) {
            const auto corners = triangles.col(t);
            const int k = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
            const int spoke = triangle_edges((k + 2) % 3, t);
            const int left = triangle_edges((k + 1) % 3, t);
            ring_vertices_.push_back(corners[(k + 1) % 3]);
            ring_spokes_.push_back(spoke);
            ring_rim_.push_back(triangle_edges(k, t));
            ++passed;
            const auto [a, b] = edge_triangles[at(left)];
            const int next = a == t ? b : a;
            if (next == none) {
                ring_vertices_.push_back(corners[(k + 2) % 3]);
                ring_spokes_.push_back(left);
            }
            t = next == first[at(v)] ? none : next;
        }
        // Several fans that meet in the vertex alone.
        if (passed != triangles_at[at(v)]) refuse(first[at(v)], v, v);
        ring_begin_.push_back(static_cast<int>(ring_vertices_.size()));
        rim_begin_.push_back(static_cast<int>(ring_rim_.size()));
    }
}

SurfaceMesh surface_mesh(const Patch& patch) {
    SurfaceMesh mesh;
    const auto vertices = at(patch.vertex_count());
    mesh.reserve(vertices, at(patch.edge_count()), at(patch.triangle_count()));
    for (std::size_t v = 0; v < vertices; ++v) mesh.add_vertex(SurfaceMesh::Point::Zero());
    for (const auto corners : patch.triangles.colwise()) {
        const auto corner = [&](int k) { return mesh.vertex_handle(static_cast<unsigned>(corners[k])); };
        mesh.add_face(corner(0), corner(1), corner(2));
    }
    return mesh;
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
