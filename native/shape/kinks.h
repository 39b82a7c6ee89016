// Kinks along a line of edges: what its vertices have of them, and where they are seen.
#pragma once

#include <array>

#include "base/types.h"

namespace fairing {

// Length-weighted means at the ends of edges.
class EdgeMeans {
public:
    explicit EdgeMeans(Eigen::Index vertex_count)
        : sum_(VectorX::Zero(vertex_count)), weight_(VectorX::Zero(vertex_count)) {}

    void add(const std::array<int, 2>& ends, double value, double length) {
        for (int v : ends) {
            sum_[v] += value * length;
            weight_[v] += length;
        }
    }

    // 0 where no edge ends.
    [[nodiscard]] double operator[](Eigen::Index v) const { return weight_[v] > 0.0 ? sum_[v] / weight_[v] : 0.0; }

private:
    VectorX sum_;
    VectorX weight_;
};

// Of the line's vertices, each named once, the places whose degrees are above the limit, along so many neighbours that
// these add up to `kink_length` times it; ascending.
Indices seen_along(const std::vector<std::array<int, 2>>& edges, const Indices& vertices, const VectorX& degrees,
                   double limit);

// Vertices at seams within a surface whose two sides are held in the same places, each with vertices of its own, as
// doubled vertices are: where these places show a kink beyond the bends that are usual around. Ascending. `held`:
// vertices that stay; `limit`: degrees from which a kink is seen (shape/visible_join).
Indices seam_kinks(const Points& points, const Triangles& triangles, const Indices& held, double limit);

}  // namespace fairing
