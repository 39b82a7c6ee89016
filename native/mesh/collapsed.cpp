#include "mesh/collapsed.h"

namespace fairing {

Triangles without_collapsed(const Triangles& triangles) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        const auto corners = triangles.col(t);
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) kept.push_back(t);
    }
    return triangles(Eigen::all, kept);
}

}  // namespace fairing
