#include "placement/refill.h"

#include <algorithm>

#include <Eigen/SparseCholesky>

namespace fairing {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// The number of each free vertex near the triangles, none elsewhere.
Indices unknowns_near(const Patch& patch, const Indices& triangles, int rings) {
    std::vector<char> near(patch.vertex_count(), 0);
    for (const int t : triangles) {
        for (const int v : patch.triangles.col(t)) near[v] = 1;
    }
    for (int k = 0; k < rings; ++k) {
        const std::vector<char> before = near;
        for (int v = 0; v < patch.vertex_count(); ++v) {
            if (!before[v]) continue;
            for (const int w : patch.ring(v).vertices) near[w] = 1;
        }
    }
    Indices number(patch.vertex_count(), none);
    int count = 0;
    for (int v = 0; v < patch.free_count; ++v) {
        if (near[v]) number[v] = count++;
    }
    return number;
}

}  // namespace

Points refilled(const Patch& patch, const Points& points, const Indices& triangles, int rings) {
    const Indices number = unknowns_near(patch, triangles, rings);
    const auto count = patch.free_count - std::count(number.begin(), number.begin() + patch.free_count, none);
    if (count == 0) return points;
    Triplets entries;
    Eigen::MatrixXd known = Eigen::MatrixXd::Zero(patch.vertex_count(), 3);
    const auto add = [&](int row, int vertex, double value) {
        if (number[vertex] != none)
            entries.emplace_back(row, number[vertex], value);
        else
            known.row(row) += value * points.col(vertex).transpose();
    };
    for (int v = 0; v < patch.vertex_count(); ++v) {
        const auto& ring = patch.ring(v).vertices;
        add(v, v, static_cast<double>(ring.size()));
        for (const int w : ring) add(v, w, -1.0);
    }
    Eigen::SparseMatrix<double> umbrellas(patch.vertex_count(), count);
    umbrellas.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SparseMatrix<double> normal = umbrellas.transpose() * umbrellas;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(normal);
    const Eigen::MatrixXd solved = factor.solve(-umbrellas.transpose() * known);
    Points result = points;
    for (int v = 0; v < patch.free_count; ++v) {
        if (number[v] != none) result.col(v) = solved.row(number[v]).transpose();
    }
    return result;
}

}  // namespace fairing
