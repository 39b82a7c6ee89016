// The normals that hold at fixed vertices.
#pragma once

#include <algorithm>
#include <span>

#include "base/types.h"

namespace fairing {

// Stored for some vertices of a mesh only, to save memory on a large one.
class FixedNormals {
public:
    FixedNormals() = default;
    // The columns of `all` at the vertices marked.
    FixedNormals(const std::vector<char>& marks, const Points& all) {
        for (std::size_t v = 0; v < marks.size(); ++v) {
            if (marks[v]) vertices_.push_back(static_cast<int>(v));
        }
        normals_ = all(Eigen::all, vertices_);
    }

    // Precondition, here and below: marked vertices.
    [[nodiscard]] Points::ConstColXpr operator()(int vertex) const { return normals_.col(column(vertex)); }
    [[nodiscard]] Points::ColXpr operator()(int vertex) { return normals_.col(column(vertex)); }
    // 3 × vertices
    [[nodiscard]] Points gather(std::span<const int> vertices) const {
        Points result(3, static_cast<Eigen::Index>(vertices.size()));
        for (std::size_t k = 0; k < vertices.size(); ++k)
            result.col(static_cast<Eigen::Index>(k)) = (*this)(vertices[k]);
        return result;
    }

private:
    [[nodiscard]] Eigen::Index column(int vertex) const {
        return std::ranges::lower_bound(vertices_, vertex) - vertices_.begin();
    }

    Indices vertices_;  // ascending
    Points normals_;
};

}  // namespace fairing
