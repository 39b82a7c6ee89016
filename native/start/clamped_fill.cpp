#include "start/clamped_fill.h"

#include "base/errors.h"
#include "problem/surface_state.h"
#include "start/globalisation.h"

namespace fairing {

Stiffness uniform_stiffness(const Patch& patch) {
    constexpr double side = 1.0 / std::numbers::sqrt3;  // half the cotangent of 60°
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

std::optional<Points> harmonic_between(const Patch& patch, Points field, const Progress& progress) {
    const Stiffness even = uniform_stiffness(patch);
    LaplaceOperator laplace(patch);
    if (!laplace.update(even, progress)) return std::nullopt;
    field.leftCols(patch.free_count).setZero();
    const Points pull = even.apply(patch, field, patch.free_count);
    field.leftCols(patch.free_count) = -laplace.solve(pull.transpose()).transpose();
    return field;
}

namespace {

// S_I (4M)⁻¹ f for a field f on all vertices.
Points weighted_rows(const Patch& patch, const Stiffness& stiffness, const Points& field) {
    const Points scaled = field.array().rowwise() / (4.0 * stiffness.mass.transpose().array());
    return stiffness.apply(patch, scaled, patch.free_count);
}

// S_I (4M)⁻¹ Sᵀ x with x zero at the free vertices.
Points pull_of_positions(const Patch& patch, const Stiffness& stiffness, const Points& fixed_points) {
    Points field = Points::Zero(3, patch.vertex_count());
    field.rightCols(fixed_points.cols()) = fixed_points;
    return weighted_rows(patch, stiffness, stiffness.apply(patch, field, patch.vertex_count()));
}

// S_I (4M)⁻¹ 2c.
Points pull_of_conormals(const Patch& patch, const Stiffness& stiffness, const Points& conormals) {
    Points field = Points::Zero(3, patch.vertex_count());
    field.rightCols(conormals.cols()) = 2.0 * conormals;
    return weighted_rows(patch, stiffness, field);
}

}  // namespace

Fill clamped_fill(const Patch& patch, const Points& fixed_points, const Points& conormals, NormalOperator& op,
                  const Progress& progress) {
    return clamped_fill(patch, uniform_stiffness(patch), fixed_points, conormals, op, progress);
}

Fill clamped_fill(const Patch& patch, const Stiffness& stiffness, const Points& fixed_points, const Points& conormals,
                  NormalOperator& op, const Progress& progress) {
    if (!op.update(stiffness, progress)) throw SolverError("the uniform fairness operator is not positive definite");
    Eigen::MatrixXd rhs(patch.free_count, 6);
    rhs << -pull_of_positions(patch, stiffness, fixed_points).transpose(),
        pull_of_conormals(patch, stiffness, conormals).transpose();
    const Eigen::MatrixXd solution = op.solve(rhs);
    return {solution.leftCols<3>().transpose(), solution.rightCols<3>().transpose()};
}

Points clamped_displacement(const Patch& patch, const Stiffness& stiffness, const Points& fixed_displacement,
                            const Points& conormal_change, const NormalOperator& op) {
    const Points rhs =
        pull_of_conormals(patch, stiffness, conormal_change) - pull_of_positions(patch, stiffness, fixed_displacement);
    return op.solve(rhs.transpose()).transpose();
}

Points membrane(const Problem& problem, const Workspace& work) {
    Points points(3, problem.patch.vertex_count());
    points << work.tangential->harmonic_positions(), problem.fixed_points;
    return points;
}

Points descend_area(const Problem& problem, Workspace& work, const Points& start, const Progress& progress) {
    const Patch& patch = problem.patch;
    SurfaceState state;
    state.points = start;
    for (int k = 0; k < most_descent_steps; ++k) {
        progress.report(static_cast<double>(k) / most_descent_steps, "minimal start");
        state.measure_faces(patch);
        if (!work.normal->update(state.stiffness, progress.here())) break;
        const Points gradient = state.stiffness.apply(patch, state.points, patch.free_count);
        const Points d = -work.normal->solve(gradient.transpose()).transpose();
        if (!d.allFinite()) break;
        state.points.leftCols(patch.free_count) += d;
        if (largest_length(d) < descended) break;
    }
    return state.points;
}

Points best_fill(const Problem& problem, Workspace& work, const Progress& progress) {
    const Patch& patch = problem.patch;
    const Points boundary = conormals(patch, problem.fixed_points, problem.fixed_normals);
    const Fill fill = clamped_fill(patch, problem.fixed_points, boundary, *work.normal, progress);
    Points points(3, patch.vertex_count());
    points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    Points best;
    double least = std::numeric_limits<double>::infinity();
    // Bulges of the linear fill: a strongly curved surface needs more than the linear theory's 1.
    for (const double sigma : {1.0, 1.5, 2.2, 3.2, 4.5}) {
        points.leftCols(patch.free_count) = fill.flat + sigma * fill.bulge;
        const double energy = willmore_energy(problem, points);
        if (energy < least) {
            least = energy;
            best = points;
        }
    }
    return best;
}

}  // namespace fairing
