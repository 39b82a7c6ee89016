#include "api/levels.h"

#include <algorithm>

#include "api/component.h"
#include "mesh/pieces.h"
#include "paper/hierarchy.h"

namespace fairing {

namespace {

using Corners = std::vector<int>;

void append(Corners& corners, const Triangles& triangles, const Indices& numbers) {
    for (int v : triangles.reshaped()) corners.push_back(numbers[v]);
}

Indices compose(const Indices& first, const Indices& then) {
    Indices result;
    for (int v : first) result.push_back(then[v]);
    return result;
}

// Triangles of one piece on each of its levels, coarse to fine, in input numbers.
std::vector<Corners> piece_levels(const Patch& patch, const View<Points>& points, int levels) {
    const Hierarchy hierarchy = build_hierarchy(patch, gather(points, patch.to_input), levels);
    std::vector<Corners> result;
    for (const Patch& level : hierarchy.patches) {
        append(result.emplace_back(), level.triangles, compose(level.to_input, patch.to_input));
    }
    append(result.emplace_back(), patch.triangles, patch.to_input);
    return result;
}

MeshLevel make_level(const Corners& corners) {
    MeshLevel level;
    level.triangles = Eigen::Map<const Triangles>(corners.data(), 3, static_cast<Eigen::Index>(corners.size() / 3));
    level.vertices = corners;
    std::sort(level.vertices.begin(), level.vertices.end());
    level.vertices.erase(std::unique(level.vertices.begin(), level.vertices.end()), level.vertices.end());
    return level;
}

}  // namespace

std::vector<MeshLevel> mesh_hierarchy(const MeshInput& input, int levels) {
    const CheckedMesh mesh = check_mesh(input);
    std::vector<std::vector<Corners>> pieces;
    std::size_t depth = 1;
    const Pieces parts(mesh.cut, mesh.roles);
    for (int k = 0; k < parts.size(); ++k) {
        pieces.push_back(piece_levels(parts.patch(k), input.vertices, levels));
        depth = std::max(depth, pieces.back().size());
    }
    std::vector<MeshLevel> result;
    for (std::size_t finer = depth; finer-- > 0;) {
        Corners corners;
        for (const auto& piece : pieces) {
            const Corners& part = piece[piece.size() - 1 - std::min(finer, piece.size() - 1)];
            corners.insert(corners.end(), part.begin(), part.end());
        }
        result.push_back(make_level(corners));
    }
    return result;
}

}  // namespace fairing
