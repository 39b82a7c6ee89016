#include "start/loft.h"

#include "geometry/face_geometry.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr double least_stream = 0.05;  // of the typical |∇u|²: below, ∇u is less and less of a direction
constexpr double tiny = 1e-30;         // instead of a division by zero

using Vector2 = Eigen::Vector2d;
using Hats = Eigen::Matrix<double, 2, 3>;

// Gradients of the three hat functions of an equilateral triangle of side 1.
Hats hat_gradients() {
    const double h = 1.0 / std::numbers::sqrt3;
    Hats gradients;
    gradients << -1.0, 1.0, 0.0, -h, -h, 2.0 * h;
    return gradients;
}

double length_of(const Problem& problem, const Indices& loop) {
    const auto place = [&](std::size_t k) { return problem.fixed_points.col(loop[k] - problem.patch.free_count); };
    double sum = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) sum += (place((k + 1) % loop.size()) - place(k)).norm();
    return sum;
}

// 0 on the longest boundary, 1 on the others.
Points levels(const Problem& problem, const std::vector<Indices>& loops) {
    const auto shorter = [&](const Indices& a, const Indices& b) {
        return length_of(problem, a) < length_of(problem, b);
    };
    const auto longest = std::max_element(loops.begin(), loops.end(), shorter);
    Points field = Points::Zero(3, problem.patch.vertex_count());
    for (auto loop = loops.begin(); loop != loops.end(); ++loop) {
        for (int v : *loop) field(0, v) = loop == longest ? 0.0 : 1.0;
    }
    return field;
}

// The equilateral stiffness, weak across the stream of u. A wave of m periods around dies out within 1 / (m √ε) of the
// way; ε is such that a round section (m = 1) reaches the other end.
Stiffness along_stream(const Patch& patch, const Stiffness& even, const Points& levels, double roundness) {
    const Hats hats = hat_gradients();
    const Eigen::RowVectorXd u = levels.row(0);
    Points slopes = Points::Zero(3, patch.triangle_count());
    for (int t = 0; t < patch.triangle_count(); ++t)
        slopes.col(t).head<2>() = hats * u(patch.triangles.col(t)).transpose();
    const VectorX squares = slopes.colwise().squaredNorm().transpose();
    const double total = squares.sum();
    const double typical = squares.squaredNorm() / (total + tiny);
    const double capacity = 0.25 * std::numbers::sqrt3 * total;  // 2 π r / l of a tube
    const double across = std::min(1.0, std::pow(roundness * capacity / (2.0 * std::numbers::pi), 2));
    Stiffness result = even;
    result.weights.setZero();
    for (int t = 0; t < patch.triangle_count(); ++t) {
        const double directed = (1.0 - across) * std::min(1.0, squares[t] / (least_stream * typical + tiny));
        const Vector2 along = slopes.col(t).head<2>() / std::sqrt(squares[t] + tiny);
        const Eigen::Matrix2d tensor =
            directed * along * along.transpose() + (1.0 - directed) * Eigen::Matrix2d::Identity();
        for (int k = 0; k < 3; ++k) {
            const double product = hats.col((k + 1) % 3).dot(tensor * hats.col((k + 2) % 3));
            result.weights[patch.triangle_edges(k, t)] -= 0.5 * std::numbers::sqrt3 * product;
        }
    }
    return result;
}

// The lines' own derivatives at the boundary, turned into the given tangent planes where these are believed.
Points turned_into_planes(const Problem& problem, const Points& derivatives, const VectorX& trust) {
    const Points given = conormals(problem.patch, problem.fixed_points, problem.fixed_normals);
    Points result = derivatives;
    for (Eigen::Index k = 0; k < result.cols(); ++k) {
        const Vector3 own = derivatives.col(k);
        const Vector3 direction =
            trust[k] * given.col(k).stableNormalized() + (1.0 - trust[k]) * own.stableNormalized();
        if (trust[k] > 0.0) result.col(k) = own.norm() * direction.stableNormalized();
    }
    return result;
}

constexpr double trusted_turn = 30.0;  // degrees between the normals at the ends of an boundary edge
constexpr double lost_turn = 60.0;     // likewise: no normal is trusted from here on

// How often a loop comes back to a vertex of the input: two boundaries joined by an edge are one loop that passes both
// ends of the edge twice.
std::size_t touching(const Patch& patch, const std::vector<Indices>& loops) {
    std::size_t count = 0;
    for (Indices loop : loops) {
        for (int& v : loop) v = patch.to_input[v];
        std::sort(loop.begin(), loop.end());
        count += loop.size() - static_cast<std::size_t>(std::unique(loop.begin(), loop.end()) - loop.begin());
    }
    return count;
}

bool is_held_elsewhere(const Patch& patch, const std::vector<Indices>& loops) {
    std::size_t on_loops = 0;
    for (const Indices& loop : loops) on_loops += loop.size();
    return patch.has_pins() || on_loops != static_cast<std::size_t>(patch.vertex_count() - patch.free_count);
}

struct Loop {
    double length = 0.0;
    Vector3 middle = Vector3::Zero();
};

Loop measured(const Indices& vertices, const Points& points) {
    Loop loop;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        const Vector3 here = points.col(vertices[k]);
        const Vector3 next = points.col(vertices[(k + 1) % vertices.size()]);
        loop.length += (next - here).norm();
        loop.middle += here / static_cast<double>(vertices.size());
    }
    return loop;
}

std::vector<Loop> loops_of(const Patch& patch, const Points& points) {
    std::vector<Loop> loops;
    for (const Indices& vertices : patch.loops()) loops.push_back(measured(vertices, points));
    return loops;
}

// Area of the straight tube between two loops; 0 for fewer or more.
double straight_area(const std::vector<Loop>& loops) {
    if (loops.size() != 2) return 0.0;
    return 0.5 * (loops[0].length + loops[1].length) * (loops[0].middle - loops[1].middle).norm();
}

double squares_of(const std::vector<Loop>& loops) {
    double squares = 0.0;
    for (const Loop& loop : loops) squares += loop.length * loop.length;
    return squares;
}

}  // namespace

std::optional<Loft> Loft::of(const Problem& problem, double roundness, const Progress& progress) {
    const Patch& patch = problem.patch;
    if (!joins_boundaries(problem)) return std::nullopt;
    Loft loft(patch);
    const auto across = harmonic_between(patch, levels(problem, patch.loops()), progress);
    if (!across) return std::nullopt;
    loft.stiffness_ = along_stream(patch, uniform_stiffness(patch), *across, roundness);
    if (!loft.laplace_->update(loft.stiffness_, progress) || !loft.clamped_->update(loft.stiffness_, progress))
        return std::nullopt;
    return loft;
}

Loft::Loft(const Patch& patch)
    : laplace_(std::make_unique<LaplaceOperator>(patch)), clamped_(std::make_unique<BiharmonicOperator>(patch)) {}

Fill Loft::over(const Problem& problem) const {
    const Patch& patch = problem.patch;
    Points lines = Points::Zero(3, patch.vertex_count());
    lines.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    const Points pull = stiffness_.apply(patch, lines, patch.free_count);
    lines.leftCols(patch.free_count) = -laplace_->solve(pull.transpose()).transpose();
    const Points derivatives =
        0.5 * stiffness_.apply(patch, lines, patch.vertex_count()).rightCols(problem.fixed_points.cols());
    const Points turned = turned_into_planes(problem, derivatives, trust_in_slopes(problem));
    const Points nowhere = Points::Zero(3, turned.cols());
    return Fill{lines.leftCols(patch.free_count),
                clamped_displacement(patch, stiffness_, nowhere, turned - derivatives, *clamped_)};
}

double straight_length_between(const Patch& patch, const Points& points) {
    const std::vector<Loop> loops = loops_of(patch, points);
    return straight_area(loops) / squares_of(loops);
}

bool may_fit_several(const Patch& patch, const Points& points) {
    const int loops = patch.loop_count();
    return loops > 2 || (loops == 2 && straight_length_between(patch, points) > longest_single);
}

bool joins_boundaries(const Problem& problem) {
    const std::vector<Indices> loops = problem.patch.loops();
    return loops.size() + touching(problem.patch, loops) > 1 && !is_held_elsewhere(problem.patch, loops);
}

VectorX trust_in_slopes(const Problem& problem) {
    VectorX trust = VectorX::Ones(problem.fixed_normals.cols());
    for (const Indices& loop : problem.patch.loops()) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const int a = loop[k] - problem.patch.free_count;
            const int b = loop[(k + 1) % loop.size()] - problem.patch.free_count;
            const double cosine = problem.fixed_normals.col(a).dot(problem.fixed_normals.col(b));
            const double turn = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
            const double here = std::clamp((lost_turn - turn) / (lost_turn - trusted_turn), 0.0, 1.0);
            trust[a] = std::min(trust[a], here);
            trust[b] = std::min(trust[b], here);
        }
    }
    return trust;
}

}  // namespace fairing
