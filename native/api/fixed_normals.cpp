#include "api/fixed_normals.h"

#include <algorithm>

namespace fairing {

FixedNormals::FixedNormals(const std::vector<char>& marks, const Points& all) {
    for (std::size_t v = 0; v < marks.size(); ++v) {
        if (marks[v]) vertices_.push_back(static_cast<int>(v));
    }
    normals_ = all(Eigen::all, vertices_);
}

Points FixedNormals::gather(std::span<const int> vertices) const {
    Points result(3, static_cast<Eigen::Index>(vertices.size()));
    for (std::size_t k = 0; k < vertices.size(); ++k) result.col(static_cast<Eigen::Index>(k)) = (*this)(vertices[k]);
    return result;
}

Eigen::Index FixedNormals::column(int vertex) const {
    return std::lower_bound(vertices_.begin(), vertices_.end(), vertex) - vertices_.begin();
}

}  // namespace fairing
