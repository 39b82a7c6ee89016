// The normals that hold at fixed vertices.
#pragma once

#include <span>

#include "base/types.h"

namespace fairing {

// Stored for some vertices of a mesh only, to save memory on a large one.
class FixedNormals {
public:
    FixedNormals() = default;
    // The columns of `all` at the vertices marked.
    FixedNormals(const std::vector<char>& marks, const Points& all);

    // Precondition, here and below: marked vertices.
    [[nodiscard]] Points::ConstColXpr operator()(int vertex) const { return normals_.col(column(vertex)); }
    [[nodiscard]] Points::ColXpr operator()(int vertex) { return normals_.col(column(vertex)); }
    // 3 × vertices
    [[nodiscard]] Points gather(std::span<const int> vertices) const;

private:
    [[nodiscard]] Eigen::Index column(int vertex) const;

    Indices vertices_;  // ascending
    Points normals_;
};

}  // namespace fairing
