#include "mesh/patch.h"

#include <algorithm>

#include "base/errors.h"
#include "base/progress.h"

namespace fairing {

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
                     {to_input[at(a)], to_input[at(b)]},
                     ElementKind::vertex,
                     {{"edges", 1}}});
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
        checkpoint(t);
        for (int k = 0; k < 3; ++k) {
            const int tail = triangles(k, t);
            const int head = triangles((k + 1) % 3, t);
            int edge = find(head, tail);
            if (edge == none) {
                if (find(tail, head) != none) refuse(t, tail, head);
                edge = edge_count();
                edge_ends.push_back({tail, head});
                edge_triangles.push_back({t, none});
            } else {
                if (edge_triangles[at(edge)][1] != none) refuse(t, tail, head);
                edge_triangles[at(edge)][1] = t;
            }
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
    for (Indices* list : {&ring_begin_, &rim_begin_}) list->reserve(at(vertex_count()) + 1);
    for (int v = 0; v < vertex_count(); ++v) {
        checkpoint(v);
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

}  // namespace fairing
