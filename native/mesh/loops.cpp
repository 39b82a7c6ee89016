#include "mesh/loops.h"

#include "base/errors.h"
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

// Marks of the vertices that so many edges reach.
std::vector<char> reached(const Patch& patch, const Indices& seeds, int edges) {
    std::vector<char> marks(patch.vertex_count(), 0);
    for (const int v : seeds) marks[v] = 1;
    Indices front = seeds;
    for (int k = 0; k < edges; ++k) {
        Indices next;
        for (const int v : front) {
            for (const int u : patch.ring(v).vertices) {
                if (marks[u]) continue;
                marks[u] = 1;
                next.push_back(u);
            }
        }
        front = std::move(next);
    }
    return marks;
}

Indices each_once(Indices numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
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

PatchStrip strip_around(const Patch& patch, const Indices& seeds, int edges) {
    const std::vector<char> near = reached(patch, seeds, edges);
    Indices kept;
    PatchStrip strip;
    strip.local.assign(near.size(), none);
    for (int t = 0; t < patch.triangle_count(); ++t) {
        const auto corners = patch.triangles.col(t);
        if (!near[corners[0]] && !near[corners[1]] && !near[corners[2]]) continue;
        kept.push_back(t);
        for (const int v : corners) strip.local[v] = v;
    }
    for (int& place : strip.local) {
        if (place == none) continue;
        strip.vertices.push_back(place);
        place = static_cast<int>(strip.vertices.size()) - 1;
    }
    strip.triangles = patch.triangles(Eigen::all, kept);
    for (int& v : strip.triangles.reshaped()) v = strip.local[v];
    return strip;
}

Indices corners_of(const Patch& patch, const Indices& triangles) {
    Indices corners;
    corners.reserve(3 * triangles.size());
    for (const int t : triangles) {
        for (const int v : patch.triangles.col(t)) corners.push_back(v);
    }
    return each_once(std::move(corners));
}

Indices triangles_at(const Patch& patch, const Indices& vertices) {
    Indices triangles;
    for (const int v : vertices) {
        for (const int edge : patch.ring(v).spokes) {
            for (const int t : patch.edge_triangles[edge]) {
                if (t != none) triangles.push_back(t);
            }
        }
    }
    return each_once(std::move(triangles));
}

bool has_free_corner(const Patch& patch, int triangle) {
    return patch.triangles.col(triangle).minCoeff() < patch.free_count;
}

Indices with_free_corner(const Patch& patch, Indices triangles) {
    std::erase_if(triangles, [&](int t) { return !has_free_corner(patch, t); });
    return triangles;
}

}  // namespace fairing
