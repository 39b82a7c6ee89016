#include "start/normal_fill.h"

#include <limits>
#include <utility>

#include "linear/sparse_cholesky.h"

namespace fairing {

namespace {

// Weight of edge lengths beside ⟨n, e⟩²; small, so that a pipe of many radii does not sag.
constexpr double length_weight = 1e-4;
// Of the screening beside the valence: the field forgets its outline over about 1/(2 √0.05) = 2.2 edges. Without it,
// what is left of the normals of a long pipe in its middle would be the mean of its rims' normals, which irregular rims
// have.
constexpr double screening = 0.05;

// L + screening · diag(L) with the uniform Laplacian L of the edges, lower triangle, and its coupling to fixed
// vertices.
struct ScreenedLaplacian {
    explicit ScreenedLaplacian(const Patch& patch) : matrix(patch.free_count, patch.free_count) {
        std::vector<Eigen::Triplet<double>> entries;
        std::vector<Eigen::Triplet<double>> couplings;
        for (const auto& [i, j] : patch.edge_ends) {
            for (const auto& [a, b] : {std::pair(i, j), std::pair(j, i)}) {
                if (!patch.is_free(a)) continue;
                entries.emplace_back(a, a, 1.0 + screening);
                if (patch.is_free(b) && a > b) entries.emplace_back(a, b, -1.0);
                if (!patch.is_free(b)) couplings.emplace_back(a, b - patch.free_count, 1.0);
            }
        }
        matrix.setFromTriplets(entries.begin(), entries.end());
        coupling.resize(patch.free_count, patch.vertex_count() - patch.free_count);
        coupling.setFromTriplets(couplings.begin(), couplings.end());
    }

    SparseMatrix matrix;
    SparseMatrix coupling;
};

// Each vertex gets the direction of its nearest fixed vertices' normals.
std::optional<Points> continued_normals(const Problem& problem, const Progress& progress) {
    const ScreenedLaplacian laplacian(problem.patch);
    SparseCholesky factor;
    if (!factor.factorise(laplacian.matrix, "the normals' continuation", progress)) return std::nullopt;
    Points normals(3, problem.patch.vertex_count());
    normals << factor.solve(laplacian.coupling * problem.fixed_normals.transpose()).transpose(), problem.fixed_normals;
    for (auto column : normals.colwise()) {
        const double length = column.norm();
        if (!(length > std::numeric_limits<double>::min())) return std::nullopt;
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

std::optional<Points> normal_fill(const Problem& problem, const Progress& progress) {
    const auto normals = continued_normals(problem, progress);
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
