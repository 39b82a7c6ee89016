// The order of a large mesh in memory. Splits make neighbours anywhere, and each walk around a vertex then waits for
// memory.
#include <algorithm>
#include <numeric>

#include "fill/equal_edge_mesh.h"
#include "mesh/renumbered.h"

namespace fairing {

namespace {

template <class T>
std::vector<T> picked(const std::vector<T>& values, const Indices& order) {
    std::vector<T> result;
    result.reserve(order.size());
    for (const int k : order) result.push_back(values[k]);
    return result;
}

// The numbers below `first`, and then those from there on that pass, by key.
template <class Passes, class Key>
Indices sorted(int first, int count, const Passes& passes, const Key& key) {
    Indices order(first);
    std::iota(order.begin(), order.end(), 0);
    std::vector<std::pair<int, int>> rest;
    for (int k = first; k < count; ++k) {
        if (passes(k)) rest.emplace_back(key(k), k);
    }
    std::sort(rest.begin(), rest.end());
    for (const auto& [where, k] : rest) order.push_back(k);
    return order;
}

}  // namespace

// The vertices on one triangle of the surface follow each other, and edges follow their vertices. What the patch has
// keeps its numbers.
void EqualEdgeMesh::sort() {
    const Indices vertices = sorted(
        patch_->vertex_count(), static_cast<int>(mesh_.n_vertices()),
        [&](int v) { return !mesh_.status(Vertex(v)).deleted(); }, [&](int v) { return where_[v].triangle; });
    Indices place(mesh_.n_vertices(), 0);
    for (std::size_t k = 0; k < vertices.size(); ++k) place[vertices[k]] = static_cast<int>(k);
    const auto last_end = [&](int e) {
        const Halfedge h = mesh_.halfedge_handle(Edge(e), 0);
        return std::max(place[mesh_.from_vertex_handle(h).idx()], place[mesh_.to_vertex_handle(h).idx()]);
    };
    const Indices edges = sorted(
        patch_->edge_count(), static_cast<int>(mesh_.n_edges()),
        [&](int e) { return !mesh_.status(Edge(e)).deleted(); }, last_end);
    mesh_ = renumbered(mesh_, vertices, edges);
    fixed_ = picked(fixed_, vertices);
    where_ = picked(where_, vertices);
    wanted_ = picked(wanted_, vertices);
    kept_ = picked(kept_, edges);
}

}  // namespace fairing
