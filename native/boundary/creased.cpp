#include "boundary/creased.h"

#include <algorithm>

#include "mesh/fans.h"

namespace fairing {

BrokenSurface broken_along(const Triangles& triangles, int vertex_count, const std::vector<std::array<int, 2>>& edges) {
    const EdgeTable table = make_edges(triangles, vertex_count);
    std::vector<char> cut(table.size(), 0);
    for (const auto& [a, b] : edges) {
        const std::array wanted{std::min(a, b), std::max(a, b)};
        const auto found = std::lower_bound(table.ends.begin(), table.ends.end(), wanted);
        if (found != table.ends.end() && *found == wanted)
            cut[static_cast<std::size_t>(found - table.ends.begin())] = 1;
    }
    const Fans fans = join_corners(triangles, twins_across(table, cut));
    BrokenSurface result{Triangles(3, triangles.cols()), fans.input_vertex};
    for (Eigen::Index c = 0; c < triangles.size(); ++c)
        result.triangles(c % 3, c / 3) = fans.of_corner[static_cast<std::size_t>(c)];
    return result;
}

}  // namespace fairing
