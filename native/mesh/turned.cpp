#include "mesh/turned.h"

#include "mesh/edges.h"
#include "mesh/union_find.h"

namespace fairing {

Indices turned_triangles(const Triangles& triangles, int vertex_count) {
    const int count = static_cast<int>(triangles.cols());
    const EdgeTable edges = make_edges(triangles, vertex_count);
    UnionFind pieces(count);
    Indices twisted;  // a triangle of each edge at which a piece disagrees with itself
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) != 2) continue;
        const int a = edges.side(e, 0);
        const int b = edges.side(e, 1);
        const bool opposite = side_tail(triangles, a) == side_tail(triangles, b);
        if (!pieces.join(a / 3, b / 3, opposite)) twisted.push_back(a / 3);
    }
    Indices votes(static_cast<std::size_t>(count), 0);  // of each piece: for its first triangle's winding
    for (int t = 0; t < count; ++t) {
        const auto [piece, against] = pieces.find(t);
        votes[piece] += against ? -1 : 1;
    }
    std::vector<char> one_sided(static_cast<std::size_t>(count), 0);
    for (const int t : twisted) one_sided[pieces.root(t)] = 1;
    Indices turned;
    for (int t = 0; t < count; ++t) {
        const auto [piece, against] = pieces.find(t);
        if (one_sided[piece] == 0 && against != (votes[piece] < 0)) turned.push_back(t);
    }
    return turned;
}

}  // namespace fairing
