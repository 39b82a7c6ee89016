#include "start/quick_surface.h"

#include "base/errors.h"
#include "geometry/flips.h"
#include "linear/sparse_cholesky.h"
#include "operators/normal_operator.h"
#include "problem/free_slopes.h"
#include "problem/surface_state.h"
#include "start/clamped_fill.h"
#include "start/globalisation.h"
#include "start/loft.h"

namespace fairing {

namespace {

// Each takes as long as a fill. The first step gives most of the gain: caps of 90° are .15 D off before it, .05 behind
// it, .04 behind the second.
constexpr int descent_steps = 2;

std::optional<Points> harmonic_map(const Problem& problem, const Progress& progress) {
    Points points = Points::Zero(3, problem.patch.vertex_count());
    points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    return harmonic_between(problem.patch, std::move(points), progress);
}

class Fills {
public:
    Fills(const Problem& problem, const Progress& progress)
        : problem_(problem),
          progress_(progress),
          conormals_(conormals(problem.patch, problem.fixed_points, problem.fixed_normals)) {
        work_.normal = std::make_unique<BiharmonicOperator>(problem.patch);
    }

    void add(const Stiffness& stiffness) {
        const Patch& patch = problem_.patch;
        Points points(3, patch.vertex_count());
        try {
            const Fill fill =
                clamped_fill(patch, stiffness, problem_.fixed_points, conormals_, *work_.normal, progress_.here());
            points << fill.flat + fill.bulge, problem_.fixed_points;
        } catch (const SolverError&) {
            return;
        }
        add(std::move(points));
    }

    // All of the shape before is smoothed, and only what is shorter than half or a quarter of D: limbs keep their
    // girth, which a fill between their ends would draw to a thread.
    void add_low_passed(ShapeBefore shape) {
        for (const double wavelength : {HUGE_VAL, 0.5, 0.25}) {
            const VectorX everywhere = VectorX::Constant(problem_.patch.vertex_count(), wavelength);
            if (auto points = shape.smoothed(everywhere, progress_.here())) add(std::move(*points));
        }
    }

    // The best one of all, further down; nothing where there is none.
    std::optional<Points> descended() {
        for (int k = 0; k < descent_steps && best_.points.cols() > 0; ++k)
            keep_better(descent_step(problem_, work_, best_.points, progress_.here()));
        if (best_.points.cols() == 0 || !best_.points.allFinite()) return std::nullopt;
        return best_.points;
    }

private:
    void add(Points points) {
        const double energy = willmore_energy(problem_, points);
        keep_better({std::move(points), 0.0, energy});
    }

    void keep_better(DescentStep found) {
        if (found.energy < best_.energy) best_ = std::move(found);
    }

    const Problem& problem_;
    const Progress& progress_;
    Points conormals_;
    Workspace work_;
    DescentStep best_{{}, 0.0, HUGE_VAL};
};

std::optional<Points> least_bent_fill(const Problem& given, const std::optional<Points>& before,
                                      const Progress& progress) {
    std::optional<Points> slopes = given.patch.has_pins() ? before : std::nullopt;
    if (given.patch.has_pins() && !slopes) slopes = harmonic_map(given, progress);
    const Problem problem = slopes ? with_slopes_of(given, *slopes) : given;
    Fills fills(problem, progress);
    fills.add(uniform_stiffness(problem.patch));
    auto shape = joins_boundaries(problem) ? ShapeBefore::of(problem, progress) : std::nullopt;
    if (shape) {
        fills.add_low_passed(std::move(*shape));
    } else if (before) {
        fills.add(bounded_stiffness(problem.patch, *before));
    }
    return fills.descended();
}

// Weight of edge lengths beside ⟨n, e⟩²; small, so that a pipe of many radii does not sag.
constexpr double length_weight = 1e-4;
// The screening relative to the valence: the field forgets its boundary over about 1/(2 √0.05) = 2.2 edges. Without it,
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

bool is_usable(const Problem& problem) {
    constexpr double most_turned = 0.05;  // of the triangles
    const Patch& patch = problem.patch;
    const Points& before = *problem.before;
    if (before.cols() != patch.vertex_count() || !before.allFinite()) return false;
    if (!(total_area(before, patch.triangles) > 1e-9)) return false;
    const auto turned = static_cast<double>(flipped_triangles(patch, before).size());
    return turned <= most_turned * patch.triangle_count();
}

// The shape before over the boundary of today.
std::optional<Points> over_boundary(const Problem& problem, const Progress& progress) {
    const Patch& patch = problem.patch;
    const Points& before = *problem.before;
    Points moves = Points::Zero(3, patch.vertex_count());
    moves.rightCols(problem.fixed_points.cols()) = problem.fixed_points - before.rightCols(problem.fixed_points.cols());
    if (moves.isZero(0.0)) return before;
    const auto everywhere = harmonic_between(patch, std::move(moves), progress);
    return everywhere ? std::optional<Points>(before + *everywhere) : std::nullopt;
}

// Gradient of ∫ |Δx|² at the shape itself, between the tangent planes wanted.
Points pull_of(const Problem& problem, const Points& points, const Stiffness& stiffness) {
    const Patch& patch = problem.patch;
    Points bending = -stiffness.apply(patch, points, patch.vertex_count());
    const Points own = -bending.rightCols(problem.fixed_points.cols());
    const Points given = 2.0 * conormals(patch, problem.fixed_points, problem.fixed_normals);
    const Eigen::RowVectorXd trust = trust_in_slopes(problem).transpose();
    bending.rightCols(own.cols()) += own + ((given - own).array().rowwise() * trust.array()).matrix();
    bending.array().rowwise() /= 4.0 * stiffness.mass.transpose().array();
    return stiffness.apply(patch, bending, patch.free_count);
}

}  // namespace

std::optional<Points> quick_surface(const Problem& problem, const Progress& progress) {
    if (problem.options.equation == Equation::soap_film) return harmonic_map(problem, progress);
    return least_bent_fill(problem, shape_before(problem, progress), progress);
}

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

Stiffness bounded_stiffness(const Patch& patch, const Points& points) {
    constexpr double largest_weight = 10.0;  // 2 / √3 between equilateral triangles
    constexpr double least_mass = 1e-3;      // of the mean
    Stiffness stiffness(patch, points);
    stiffness.weights = stiffness.weights.cwiseMax(-largest_weight).cwiseMin(largest_weight);
    stiffness.mass = stiffness.mass.cwiseMax(least_mass * stiffness.mass.mean());
    return stiffness;
}

std::optional<Points> shape_before(const Problem& problem, const Progress& progress) {
    return is_usable(problem) ? over_boundary(problem, progress) : std::nullopt;
}

std::optional<ShapeBefore> ShapeBefore::of(const Problem& problem, const Progress& progress) {
    auto points = shape_before(problem, progress);
    if (!points) return std::nullopt;
    return ShapeBefore(problem, std::move(*points));
}

ShapeBefore::ShapeBefore(const Problem& problem, Points points)
    : problem_(problem),
      points_(std::move(points)),
      stiffness_(bounded_stiffness(problem.patch, points_)),
      pull_(pull_of(problem, points_, stiffness_)),
      operator_(problem.patch, points_.leftCols(problem.patch.free_count)) {}

std::optional<Points> ShapeBefore::smoothed(const VectorX& wavelengths, const Progress& progress) {
    const int count = problem_.patch.free_count;
    const VectorX factors = (2.0 * std::numbers::pi / wavelengths.head(count).array()).pow(4);
    if (!operator_.update_with_mass(stiffness_, factors, progress)) return std::nullopt;
    Points result = points_;
    result.leftCols(count) += operator_.solve(pull_.transpose()).transpose();
    return result;
}

}  // namespace fairing
