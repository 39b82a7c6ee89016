#include "placement/refill.h"

#include "linear/sparse_cholesky.h"

namespace fairing {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// The free vertices near the triangles.
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
    Indices unknowns;
    for (int v = 0; v < patch.free_count; ++v) {
        if (near[v]) unknowns.push_back(v);
    }
    return unknowns;
}

}  // namespace

Points refilled(const Patch& patch, const Points& points, const Indices& triangles, int rings) {
    const Indices unknowns = unknowns_near(patch, triangles, rings);
    if (unknowns.empty()) return points;
    Indices number(patch.vertex_count(), none);
    for (std::size_t k = 0; k < unknowns.size(); ++k) number[unknowns[k]] = static_cast<int>(k);
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
    SparseMatrix umbrellas(patch.vertex_count(), static_cast<Eigen::Index>(unknowns.size()));
    umbrellas.setFromTriplets(entries.begin(), entries.end());
    const SparseMatrix normal = umbrellas.transpose() * umbrellas;
    SparseCholesky factor(points(Eigen::all, unknowns));
    if (!factor.factorise(normal.triangularView<Eigen::Lower>(), "placement", Progress())) return points;
    Points result = points;
    result(Eigen::all, unknowns) = factor.solve(-umbrellas.transpose() * known).transpose();
    return result;
}

}  // namespace fairing
