#include "solver/normal_fill.h"

#include "linear/sparse_cholesky.h"

namespace fairing {

namespace {

// Weight of edge lengths beside ⟨n, e⟩²; small, so that a pipe of many radii does not sag.
constexpr double length_weight = 1e-4;
// The harmonic field may shrink along a pipe, but where it all but vanishes it has no direction.
constexpr double smallest_normal = 1e-6;

std::optional<Points> continued_normals(const Problem& problem, const TangentialStep& tangential) {
    Points normals(3, problem.patch.vertex_count());
    normals << tangential.harmonic_extension(problem.fixed_normals), problem.fixed_normals;
    for (auto column : normals.colwise()) {
        const double length = column.norm();
        if (!(length > smallest_normal)) return std::nullopt;
        column /= length;
    }
    return normals;
}

// The quadratic form Σ_edges |W_e (x_i − x_j)|² with W_e = n nᵀ + length_weight · 1, lower triangle, and its right-hand
// side.
struct Assembly {
    explicit Assembly(const Problem& assembled)
        : problem(assembled), rhs(VectorX::Zero(3L * assembled.patch.free_count)) {}

    void add(int i, int j, const Eigen::Matrix3d& block) {
        const Patch& patch = problem.patch;
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) {
                if (r >= c) entries.emplace_back(3 * i + r, 3 * i + c, block(r, c));
                if (patch.is_free(j) && i > j) entries.emplace_back(3 * i + r, 3 * j + c, -block(r, c));
            }
        }
        if (!patch.is_free(j)) rhs.segment<3>(3L * i) += block * problem.fixed_points.col(j - patch.free_count);
    }

    const Problem& problem;
    std::vector<Eigen::Triplet<double>> entries;
    VectorX rhs;
};

Assembly assemble(const Problem& problem, const Points& normals) {
    Assembly assembly(problem);
    for (const auto& [i, j] : problem.patch.edge_ends) {
        const Vector3 n = (normals.col(i) + normals.col(j)).normalized();
        const Eigen::Matrix3d block = n * n.transpose() + length_weight * Eigen::Matrix3d::Identity();
        if (problem.patch.is_free(i)) assembly.add(i, j, block);
        if (problem.patch.is_free(j)) assembly.add(j, i, block);
    }
    return assembly;
}

}  // namespace

std::optional<Points> normal_fill(const Problem& problem, const TangentialStep& tangential, const Progress& progress) {
    const auto normals = continued_normals(problem, tangential);
    if (!normals) return std::nullopt;
    const Assembly assembly = assemble(problem, *normals);
    SparseMatrix matrix(assembly.rhs.size(), assembly.rhs.size());
    matrix.setFromTriplets(assembly.entries.begin(), assembly.entries.end());
    SparseCholesky factor;
    if (!factor.factorise(matrix, "the normals' fill", progress)) return std::nullopt;
    const Eigen::MatrixXd solution = factor.solve(assembly.rhs);
    Points points(3, problem.patch.vertex_count());
    points << Eigen::Map<const Points>(solution.data(), 3, problem.patch.free_count), problem.fixed_points;
    if (!points.allFinite()) return std::nullopt;
    return points;
}

}  // namespace fairing
