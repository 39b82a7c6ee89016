#include "mesh/fans.h"

#include <algorithm>

#include "base/progress.h"
#include "mesh/union_find.h"

namespace fairing {

namespace {

int corner_at(const Triangles& triangles, int side, int vertex) {
    return 3 * (side / 3) + (side_tail(triangles, side) == vertex ? side % 3 : (side % 3 + 1) % 3);
}

Fans number_fans(const Triangles& triangles, UnionFind& corners) {
    Fans fans;
    const int corner_count = 3 * static_cast<int>(triangles.cols());
    fans.of_corner.assign(at(corner_count), none);
    for (int c = 0; c < corner_count; ++c) {
        checkpoint(c);
        int& fan = fans.of_corner[at(corners.root(c))];
        if (fan == none) {
            fan = static_cast<int>(fans.input_vertex.size());
            fans.input_vertex.push_back(triangles(c % 3, c / 3));
        }
        fans.of_corner[at(c)] = fan;
    }
    return fans;
}

std::array<int, 3> sorted_fans(const Fans& fans, int triangle) {
    std::array<int, 3> result{};
    for (int k = 0; k < 3; ++k) result[at(k)] = fans.of_corner[at(3 * triangle + k)];
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace

Fans join_corners(const Triangles& triangles, const EdgeTable& edges, const std::vector<char>& cut) {
    UnionFind corners(3 * static_cast<int>(triangles.cols()));
    for (int e = 0; e < edges.size(); ++e) {
        checkpoint(e);
        if (cut[at(e)] || edges.side_count(e) != 2) continue;
        for (int v : edges.ends[at(e)]) {
            corners.join(corner_at(triangles, edges.side(e, 0), v), corner_at(triangles, edges.side(e, 1), v));
        }
    }
    return number_fans(triangles, corners);
}

Indices doubled_triangles(const Triangles& triangles, const EdgeTable& edges, const Fans& fans) {
    // A pocket has an edge that joins it, since its corners are joined: the two sides of that one are looked at.
    Indices result;
    for (int e = 0; e < edges.size(); ++e) {
        checkpoint(e);
        if (edges.side_count(e) != 2) continue;
        const int a = edges.side(e, 0) / 3;
        const int b = edges.side(e, 1) / 3;
        if (triangles.col(a).sum() != triangles.col(b).sum() || sorted_fans(fans, a) != sorted_fans(fans, b)) continue;
        result.insert(result.end(), {a, b});
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

}  // namespace fairing
