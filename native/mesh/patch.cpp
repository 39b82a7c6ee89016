#include "mesh/patch.h"

#include <atomic>

#include "base/errors.h"
#include "base/limits.h"
#include "base/parallel.h"
#include "base/progress.h"

namespace fairing {

Patch::Patch(PatchMembers members, Twins twins) : PatchMembers(std::move(members)) {
    const Misfit misfit = twins.empty() ? find_twins(triangles, vertex_count(), twins) : join_borders(triangles, twins);
    if (misfit) refuse(*misfit);
    number_edges(twins);
    flatten_rings(twins);
}

bool Patch::has_pins() const { return std::find(pin.begin(), pin.end(), 1) != pin.end(); }

std::vector<Indices> Patch::loops() const {
    std::vector<char> seen(vertex_count(), 0);
    std::vector<Indices> result;
    for (int start = free_count; start < vertex_count(); ++start) {
        if (seen[start] || ring(start).closed()) continue;
        Indices& loop = result.emplace_back();
        // The first neighbour of an open ring lies behind the border edge with the patch on its left.
        for (int v = start; !seen[v]; v = ring(v).vertices.front()) {
            seen[v] = 1;
            loop.push_back(v);
        }
    }
    return result;
}

void Patch::refuse(int side) const {
    throw MeshError({Code::nonmanifold_edge,
                     "triangle " + std::to_string(input_triangle[side / 3]) + " clashes with its neighbours: delete it",
                     {to_input[side_tail(triangles, side)], to_input[side_head(triangles, side)]},
                     ElementKind::vertex,
                     {{"edges", 1}}});
}

// Edges in the order in which the triangles' sides first show them.
void Patch::number_edges(const Twins& twins) {
    triangle_edges.resize(3, triangle_count());
    edge_ends.reserve(twins.size() / 2 + (vertex_count() / 8 + 8));
    edge_triangles.reserve(edge_ends.capacity());
    const auto edge_of = [&](int side) -> int& { return triangle_edges((side + 2) % 3, side / 3); };
    for (int side = 0; side < static_cast<int>(twins.size()); ++side) {
        checkpoint(side);
        const int twin = twins[side];
        if (twin != none && twin < side) {
            edge_of(side) = edge_of(twin);
            continue;
        }
        edge_of(side) = edge_count();
        edge_ends.push_back({side_tail(triangles, side), side_head(triangles, side)});
        edge_triangles.push_back({side / 3, twin == none ? none : twin / 3});
    }
}

// The side at which the walk around each ring begins: at border vertices the one with the border behind it.
void Patch::lay_out_rings(const Twins& twins, Indices& first) {
    first.assign(vertex_count(), none);
    rim_begin_.assign(vertex_count() + 1, 0);
    for (int side = 0; side < static_cast<int>(twins.size()); ++side) {
        const int v = side_tail(triangles, side);
        ++rim_begin_[v + 1];
        if (first[v] == none || twins[side] == none) first[v] = side;
    }
    ring_begin_.assign(rim_begin_.size(), 0);
    for (std::size_t v = 0; v < first.size(); ++v) {
        const bool open = first[v] != none && twins[first[v]] == none;
        ring_begin_[v + 1] = ring_begin_[v] + rim_begin_[v + 1] + (open ? 1 : 0);
        rim_begin_[v + 1] += rim_begin_[v];
    }
    for (Indices* list : {&ring_vertices_, &ring_spokes_}) list->resize(ring_begin_.back());
    ring_rim_.resize(rim_begin_.back());
}

// False where several fans meet in the vertex alone.
bool Patch::fill_ring(int vertex, int first, const Twins& twins) {
    int place = ring_begin_[vertex];
    int rim = rim_begin_[vertex];
    const int end = rim_begin_[vertex + 1];
    for (int side = first; side != none;) {
        if (rim == end || side_tail(triangles, side) != vertex) return false;
        const int t = side / 3;
        const int k = side % 3;
        const int last = 3 * t + (k + 2) % 3;  // leads back
        ring_vertices_[place] = side_head(triangles, side);
        ring_spokes_[place++] = triangle_edges((k + 2) % 3, t);
        ring_rim_[rim++] = triangle_edges(k, t);
        side = twins[last];
        if (side == none) {
            ring_vertices_[place] = side_tail(triangles, last);
            ring_spokes_[place++] = triangle_edges((k + 1) % 3, t);
        }
        if (side == first) break;
    }
    return rim == end;
}

// No edge twice.
bool Patch::has_neighbours_once(int vertex) const {
    const auto neighbours = ring(vertex).vertices;
    if (std::ssize(neighbours) > one_by_one) {
        Indices sorted(neighbours.begin(), neighbours.end());
        std::sort(sorted.begin(), sorted.end());
        return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
    }
    for (auto v = neighbours.begin(); v != neighbours.end(); ++v) {
        if (std::find(neighbours.begin(), v, *v) != v) return false;
    }
    return true;
}

void Patch::flatten_rings(const Twins& twins) {
    Indices first;
    lay_out_rings(twins, first);
    std::atomic<int> misfit = vertex_count();
    for_ranges(vertex_count(), coarse_grain, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) {
            if (fill_ring(v, first[v], twins) && has_neighbours_once(v)) continue;
            int least = misfit;
            while (v < least && !misfit.compare_exchange_weak(least, v)) {
            }
            return;
        }
    });
    if (misfit < vertex_count()) refuse(first[misfit]);
}

}  // namespace fairing
