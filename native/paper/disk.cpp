#include "paper/disk.h"

namespace fairing {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// The corner of triangle t that is neither a nor b.
int third_corner(const Triangles& triangles, int t, int a, int b) {
    for (int v : triangles.col(t)) {
        if (v != a && v != b) return v;
    }
    return none;
}

int apex_beyond(const Patch& patch, int centre, int edge) {
    const auto [a, b] = patch.edge_ends[at(edge)];
    for (int t : patch.edge_triangles[at(edge)]) {
        if (t == none) continue;
        const int apex = third_corner(patch.triangles, t, a, b);
        if (apex != centre) return apex;
    }
    return none;
}

}  // namespace

DiskTable::DiskTable(const Patch& patch) : patch_(patch) {
    begin_.reserve(at(patch.vertex_count()) + 1);
    apexes_.reserve(2 * at(patch.edge_count()));
    for (int v = 0; v < patch.vertex_count(); ++v) {
        const RingView ring = patch.ring(v);
        for (int edge : ring.rim) apexes_.push_back(apex_beyond(patch, v, edge));
        if (!ring.closed()) apexes_.push_back(none);
        begin_.push_back(static_cast<int>(apexes_.size()));
    }
}

Disk DiskTable::operator[](int vertex) const {
    const RingView ring = patch_.ring(vertex);
    return {vertex, ring.vertices, std::span(apexes_).subspan(at(begin_[at(vertex)]), ring.valence()), ring.closed()};
}

}  // namespace fairing
