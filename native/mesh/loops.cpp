#include "mesh/loops.h"

#include <algorithm>
#include <string>

#include "base/errors.h"
#include "base/text.h"
#include "mesh/topology.h"

namespace fairing {

namespace {

// Side that follows a border side: turn around its head through the fan until the next border side.
int next_border_side(const Triangles& triangles, const EdgeTable& edges, int side) {
    int next = 3 * (side / 3) + (side % 3 + 1) % 3;
    const int limit = 3 * static_cast<int>(triangles.cols());
    for (int guard = 0; guard < limit; ++guard) {
        const int edge = edges.edge_of_side[next];
        if (edges.side_count(edge) == 1) break;
        const int twin = edges.side(edge, 0) == next ? edges.side(edge, 1) : edges.side(edge, 0);
        next = 3 * (twin / 3) + (twin % 3 + 1) % 3;
    }
    return next;
}

// The triangles in input vertices, wound as in the cut mesh. Cuts through the mesh are no border and stay closed.
Triangles wound_triangles(const CutMesh& mesh) {
    Triangles result(3, mesh.triangles.cols());
    for (int c = 0; c < 3 * result.cols(); ++c) result(c % 3, c / 3) = mesh.input_vertex[mesh.triangles(c % 3, c / 3)];
    return result;
}

// A single-sided piece without free vertices is no matter for cut_mesh, but has no left.
void check_windings(const Triangles& triangles, const EdgeTable& edges, const Indices& input_triangle) {
    Indices offenders;
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) != 2) continue;
        const int side = edges.side(e, 0);
        if (side_tail(triangles, side) != side_tail(triangles, edges.side(e, 1))) continue;
        offenders.push_back(input_triangle[side / 3]);
    }
    if (offenders.empty()) return;
    throw MeshError(about(Code::not_orientable,
                          "the mesh is single-sided (like a Möbius strip): its border has no left side", offenders,
                          ElementKind::triangle, "triangles"));
}

}  // namespace

std::vector<Indices> boundary_loops(const Triangles& input, int vertex_count) {
    Diagnostics ignored;
    Indices kept;
    const Triangles whole = drop_collapsed_triangles(input, kept, ignored);
    const EdgeTable given = make_edges(whole, vertex_count);
    const VertexRoles roles = classify_vertices(given, {std::vector<char>(vertex_count, 0), {}, {}});
    const CutMesh mesh = cut_mesh(whole, given, kept, roles, ignored);
    const Triangles triangles = wound_triangles(mesh);
    const EdgeTable edges = make_edges(triangles, vertex_count);
    check_windings(triangles, edges, mesh.input_triangle);

    std::vector<char> visited(edges.edge_of_side.size(), 0);
    std::vector<Indices> loops;
    for (int s = 0; s < static_cast<int>(visited.size()); ++s) {
        if (visited[s] || edges.side_count(edges.edge_of_side[s]) != 1) continue;
        Indices loop;
        for (int side = s; !visited[side]; side = next_border_side(triangles, edges, side)) {
            visited[side] = 1;
            loop.push_back(side_tail(triangles, side));
        }
        std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
        loops.push_back(std::move(loop));
    }
    std::sort(loops.begin(), loops.end());
    return loops;
}

}  // namespace fairing
