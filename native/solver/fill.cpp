#include "solver/fill.h"

#include <numbers>

#include "base/errors.h"

namespace fairing {

Stiffness uniform_stiffness(const Patch& patch) {
    constexpr double side = 1.0 / std::numbers::sqrt3;
    Stiffness stiffness;
    stiffness.weights.resize(patch.edge_count());
    stiffness.mass.setZero(patch.vertex_count());
    for (int e = 0; e < patch.edge_count(); ++e) {
        stiffness.weights[e] = patch.edge_triangles[static_cast<std::size_t>(e)][1] == none ? side : 2.0 * side;
    }
    for (int t = 0; t < patch.triangle_count(); ++t) {
        for (int v : patch.triangles.col(t)) stiffness.mass[v] += std::numbers::sqrt3 / 12.0;
    }
    return stiffness;
}

namespace {

// S_I (4M)⁻¹ f for a field f on all vertices.
Points weighted_rows(const Patch& patch, const Stiffness& stiffness, const Points& field) {
    const Points scaled = field.array().rowwise() / (4.0 * stiffness.mass.transpose().array());
    return stiffness.apply(patch, scaled, patch.free_count);
}

}  // namespace

Fill clamped_fill(const Patch& patch, const Points& fixed_points, const Points& conormals, NormalOperator& op,
                  const Progress& progress) {
    return clamped_fill(patch, uniform_stiffness(patch), fixed_points, conormals, op, progress);
}

Fill clamped_fill(const Patch& patch, const Stiffness& stiffness, const Points& fixed_points, const Points& conormals,
                  NormalOperator& op, const Progress& progress) {
    if (!op.update(stiffness, progress)) throw SolverError("the uniform fairness operator is not positive definite");
    Points boundary = Points::Zero(3, patch.vertex_count());
    boundary.rightCols(fixed_points.cols()) = fixed_points;
    const Points from_positions =
        weighted_rows(patch, stiffness, stiffness.apply(patch, boundary, patch.vertex_count()));
    boundary.rightCols(fixed_points.cols()) = 2.0 * conormals;
    const Points from_conormals = weighted_rows(patch, stiffness, boundary);
    Eigen::MatrixXd rhs(patch.free_count, 6);
    rhs << -from_positions.transpose(), from_conormals.transpose();
    const Eigen::MatrixXd solution = op.solve(rhs);
    return {solution.leftCols<3>().transpose(), solution.rightCols<3>().transpose()};
}

}  // namespace fairing
