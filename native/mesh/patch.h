// One connected piece of the cut mesh, with flat adjacency arrays for the numerics.
#pragma once

#include "mesh/topology.h"
#include "mesh/twins.h"

namespace fairing {

// The neighbours of one vertex, counter-clockwise; on the border from the first border edge to the last.
struct RingView {
    std::span<const int> vertices;  // neighbour k
    std::span<const int> spokes;    // edge to neighbour k
    std::span<const int> rim;       // edge from neighbour k to k + 1; one entry less than vertices when open
    [[nodiscard]] bool closed() const { return rim.size() == vertices.size(); }
    [[nodiscard]] std::size_t valence() const { return vertices.size(); }
};

// Input of a patch. Local vertices 0 … free_count − 1 are free, the others fixed.
struct PatchMembers {
    int free_count = 0;
    Indices to_input;        // local vertex → input vertex
    Indices input_triangle;  // local triangle → input triangle
    std::vector<char> pin;   // per local vertex: fixed position, no prescribed normal
    Triangles triangles;     // local, consistently wound
};

// Topology of a patch.
class Patch : public PatchMembers {
public:
    // Precondition: a manifold with consistent windings. `twins`: of its triangles where they are known; empty: they
    // are searched.
    explicit Patch(PatchMembers members, Twins twins = {});

    [[nodiscard]] int vertex_count() const { return static_cast<int>(to_input.size()); }
    [[nodiscard]] int edge_count() const { return static_cast<int>(edge_ends.size()); }
    [[nodiscard]] int triangle_count() const { return static_cast<int>(triangles.cols()); }
    [[nodiscard]] bool is_free(int vertex) const { return vertex < free_count; }
    [[nodiscard]] bool has_pins() const;
    [[nodiscard]] RingView ring(int vertex) const;
    // Closed loops of border edges, the patch on their left, vertex by vertex.
    [[nodiscard]] std::vector<Indices> loops() const;
    [[nodiscard]] int loop_count() const { return static_cast<int>(loops().size()); }

    Triangles triangle_edges;  // edge opposite to corner k of each triangle
    std::vector<std::array<int, 2>> edge_ends;
    std::vector<std::array<int, 2>> edge_triangles;  // second entry `none` on the border

private:
    void number_edges(const Twins& twins);
    void flatten_rings(const Twins& twins);
    void lay_out_rings(const Twins& twins, Indices& first);
    bool fill_ring(int vertex, int first, const Twins& twins);
    [[nodiscard]] bool has_neighbours_once(int vertex) const;
    [[noreturn]] void refuse(int side) const;

    Indices ring_begin_;
    Indices ring_vertices_;
    Indices ring_spokes_;
    Indices rim_begin_;
    Indices ring_rim_;
};

inline RingView Patch::ring(int vertex) const {
    const auto view = [vertex](const Indices& begin, const Indices& items) {
        const auto first = begin[vertex];
        return std::span<const int>(items.data() + first, (begin[vertex + 1]) - first);
    };
    return {view(ring_begin_, ring_vertices_), view(ring_begin_, ring_spokes_), view(rim_begin_, ring_rim_)};
}

}  // namespace fairing
