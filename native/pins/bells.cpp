#include "pins/bells.h"

#include "base/errors.h"
#include "linear/sparse_cholesky.h"

namespace fairing {

namespace {

constexpr int steps = 8;  // of heat

// M + t S / 2, lower triangle: one implicit step of heat.
SparseMatrix heat_matrix(const Patch& patch, const Stiffness& stiffness, double time) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(patch.vertex_count() + patch.edge_count());
    for (int v = 0; v < patch.vertex_count(); ++v)
        entries.emplace_back(v, v, stiffness.mass[v] + 0.5 * time * stiffness.diagonal(patch, v));
    for (int e = 0; e < patch.edge_count(); ++e) {
        const auto [a, b] = patch.edge_ends[e];
        entries.emplace_back(std::max(a, b), std::min(a, b), -0.5 * time * stiffness.weights[e]);
    }
    SparseMatrix matrix(patch.vertex_count(), patch.vertex_count());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

}  // namespace

Eigen::MatrixXd bells(const Patch& patch, const Points& points, const Stiffness& stiffness, const Indices& centres,
                      double radius, const Progress& progress) {
    SparseCholesky factor(points);
    const double time = 0.5 * radius * radius / steps;
    if (!factor.factorise(heat_matrix(patch, stiffness, time), "pins", progress))
        throw SolverError("the radius of pins can't be measured on a surface that has degenerated");
    const auto count = static_cast<Eigen::Index>(centres.size());
    Eigen::MatrixXd heat = Eigen::MatrixXd::Zero(patch.vertex_count(), count);
    for (Eigen::Index k = 0; k < count; ++k) heat(centres[static_cast<std::size_t>(k)], k) = 1.0;
    for (int k = 0; k < steps; ++k) {
        if (k > 0) heat = stiffness.mass.asDiagonal() * heat;
        heat = factor.solve(heat);
    }
    for (Eigen::Index k = 0; k < count; ++k) heat.col(k) /= heat(centres[static_cast<std::size_t>(k)], k);
    return heat;
}

}  // namespace fairing
