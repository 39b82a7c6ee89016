#include "mesh/loops.h"

#include <algorithm>
#include <string>

#include "mesh/topology.h"

namespace fairing {

namespace {

// Side that follows a border side: turn around its head through the fan until the next border side.
int next_border_side(const Triangles& triangles, const EdgeTable& edges, int side) {
    int next = 3 * (side / 3) + (side % 3 + 1) % 3;
    const int limit = 3 * static_cast<int>(triangles.cols());
    for (int guard = 0; guard < limit; ++guard) {
        const int edge = edges.edge_of_side[at(next)];
        if (edges.side_count(edge) == 1) break;
        const int twin = edges.side(edge, 0) == next ? edges.side(edge, 1) : edges.side(edge, 0);
        next = 3 * (twin / 3) + (twin % 3 + 1) % 3;
    }
    return next;
}

}  // namespace

std::vector<Indices> boundary_loops(const Triangles& input, int vertex_count) {
    Diagnostics ignored;
    Indices kept;
    const Triangles triangles = drop_collapsed_triangles(input, kept, ignored);
    const VertexRoles roles =
        classify_vertices(make_edges(triangles, vertex_count), std::vector<char>(at(vertex_count), 0));
    const CutMesh mesh = cut_mesh(triangles, kept, roles, ignored);
    const EdgeTable edges = make_edges(mesh.triangles, static_cast<int>(mesh.input_vertex.size()));

    std::vector<char> visited(edges.edge_of_side.size(), 0);
    std::vector<Indices> loops;
    for (int s = 0; s < static_cast<int>(visited.size()); ++s) {
        if (visited[at(s)] || edges.side_count(edges.edge_of_side[at(s)]) != 1) continue;
        Indices loop;
        for (int side = s; !visited[at(side)]; side = next_border_side(mesh.triangles, edges, side)) {
            visited[at(side)] = 1;
            loop.push_back(mesh.input_vertex[at(side_tail(mesh.triangles, side))]);
        }
        std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
        loops.push_back(std::move(loop));
    }
    std::sort(loops.begin(), loops.end());
    return loops;
}

}  // namespace fairing
