#include "variation/lift.h"

#include <Eigen/Cholesky>

#include "base/columns.h"
#include "base/limits.h"
#include "operators/normal_operator.h"
#include "start/clamped_fill.h"
#include "variation/element.h"

namespace fairing {

namespace {

constexpr int most_steps = 4;             // of Newton's method, from a foot on the flat triangle
constexpr double at_vertex = 1.0 - 1e-9;  // barycentric weight
constexpr double farthest = 0.1;          // of an edge, from the curved triangle

// One Gauss–Newton step for the motion of a sample.
Motion fitted_motion(const SurfaceSample& sample, const Sheet& sheet, const Stencil& stencil, const LocalCubic& cubic) {
    const Frame frame(sample.normal);
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Vector3 rhs = Vector3::Zero();
    for (int vertex : stencil) {
        if (vertex == none) continue;
        const Vector3 along = sheet.points.col(vertex) - sample.point;
        const double length = along.norm();
        const Vector3 sum = sheet.normals.col(vertex) + sample.normal;
        const double residual = sum.dot(along) - length * length * length / 6.0 * cubic.along(along);
        const Vector3 row(-sum.dot(sample.normal), frame.u.dot(along), frame.v.dot(along));
        const double weight = std::pow(length, -4);  // of what is left of the next order, squared
        matrix += weight * row * row.transpose();
        rhs -= weight * residual * row;
    }
    return matrix.ldlt().solve(rhs);
}

constexpr double share = 0.8;       // of the boundary's spacing
constexpr double converged = 1e-3;  // units of D

// Logarithms of the mean lengths of the two border edges at each fixed vertex, zero elsewhere.
VectorX boundary_lengths(const Problem& problem) {
    const Patch& patch = problem.patch;
    VectorX logarithms = VectorX::Zero(patch.vertex_count());
    for (const Indices& loop : patch.loops()) {
        const auto size = loop.size();
        const auto place = [&](std::size_t k) { return problem.fixed_points.col(loop[k % size] - patch.free_count); };
        for (std::size_t k = 0; k < size; ++k) {
            const double sum = (place(k + 1) - place(k)).norm() + (place(k) - place(k + size - 1)).norm();
            logarithms[loop[k]] = std::log(std::max(0.5 * sum, std::numeric_limits<double>::min()));
        }
    }
    return logarithms;
}

class Inflation {
public:
    Inflation(const Problem& problem, const Progress& progress)
        : patch_(problem.patch), stiffness_(uniform_stiffness(problem.patch)), laplace_(problem.patch) {
        ready_ = laplace_.update(stiffness_, progress);
        if (!ready_) return;
        VectorX logarithms = boundary_lengths(problem);
        const Eigen::RowVectorXd row = logarithms.transpose();
        logarithms.head(patch_.free_count) =
            -laplace_.solve(stiffness_.apply(patch_, row, patch_.free_count).transpose());
        spacing_ = logarithms.array().exp();
    }

    [[nodiscard]] bool ready() const { return ready_; }

    // Moves the free vertices; gives the largest coordinate of their displacements.
    double round(Points& points) const {
        Points pull = Points::Zero(3, patch_.free_count);
        for (int e = 0; e < patch_.edge_count(); ++e) {
            const auto [i, j] = patch_.edge_ends[e];
            const Vector3 edge = points.col(j) - points.col(i);
            const double wanted = share * std::sqrt(spacing_[i] * spacing_[j]);
            const Vector3 longer = std::max(0.0, wanted - edge.norm()) * direction(edge);
            if (patch_.is_free(i)) pull.col(i) -= stiffness_.weights[e] * longer;
            if (patch_.is_free(j)) pull.col(j) += stiffness_.weights[e] * longer;
        }
        const Points moves = laplace_.solve(pull.transpose()).transpose();
        points.leftCols(patch_.free_count) += moves;
        return moves.cwiseAbs().maxCoeff();
    }

private:
    const Patch& patch_;
    Stiffness stiffness_;
    LaplaceOperator laplace_;
    VectorX spacing_;
    bool ready_ = false;
};

// Vertex of a snapshot by its number in the mesh, `none` for numbers that are not there.
class VertexByNumber {
public:
    explicit VertexByNumber(const Patch& patch) {
        for (int v = 0; v < patch.vertex_count(); ++v) {
            const auto number = static_cast<std::size_t>(patch.to_input[v]);
            if (number >= vertex_.size()) vertex_.resize(number + 1, none);
            vertex_[number] = v;
        }
    }
    [[nodiscard]] int operator()(int number) const {
        return static_cast<std::size_t>(number) < vertex_.size() ? vertex_[number] : none;
    }

private:
    Indices vertex_;
};

// A triangle of the solved mesh near each vertex of the later one: of the vertex itself, or of the nearest that was
// there before.
Indices triangles_nearby(const SolvedSheet& solved, const Patch& later, const TargetSurface& target) {
    const VertexByNumber before(solved.mesh.patch);
    Indices triangle(later.vertex_count(), none);
    Indices queue;
    for (int v = 0; v < later.vertex_count(); ++v) {
        const int old = before(later.to_input[v]);
        if (old == none) continue;
        triangle[v] = target.at_vertex(old).triangle;
        queue.push_back(v);
    }
    for (std::size_t k = 0; k < queue.size(); ++k) {
        for (int u : later.ring(queue[k]).vertices) {
            if (triangle[u] != none) continue;
            triangle[u] = triangle[queue[k]];
            queue.push_back(u);
        }
    }
    return triangle;
}

// A free edge rises along normals that are known only in the end, and has drifted within the surface by then: it begins
// each mesh at the point of its tangent plane above or below the curve that was given.
void undo_drift(const Problem& problem, Sheet& sheet) {
    if (problem.free_edge.empty()) return;
    for (Eigen::Index k = 0; k < problem.fixed_points.cols(); ++k) {
        if (!problem.free_edge[static_cast<std::size_t>(k)]) continue;
        auto point = sheet.points.col(problem.patch.free_count + k);
        const Vector3 given = problem.fixed_points.col(k);
        const Vector3 normal = sheet.normals.col(problem.patch.free_count + k);
        point = given + normal.dot(point - given) * normal;
    }
}

}  // namespace

Lift::Lift(const Patch& patch, const Sheet& sheet) : sheet_(sheet), stencils_(stencils(patch)) {}

SurfaceSample Lift::sample(const TargetSurface& target, const SurfacePoint& where) const {
    const Stencil& stencil = stencils_[where.triangle];
    for (int k = 0; k < 3; ++k) {
        const int corner = stencil[k];
        if (where.weights[k] > at_vertex) return {sheet_.points.col(corner), sheet_.normals.col(corner)};
    }
    const SurfaceSample first{target.position(where), target.normal(where)};
    const LocalCubic cubic = local_cubic(sheet_, stencil);
    SurfaceSample best = first;
    for (int step = 0; step < most_steps; ++step) {
        const Motion motion = fitted_motion(best, sheet_, stencil, cubic);
        if (!motion.allFinite()) return first;
        const Frame frame(best.normal);
        best.point += motion[0] * best.normal;
        best.normal = (best.normal + motion[1] * frame.u + motion[2] * frame.v).normalized();
    }
    const double edge = (sheet_.points.col(stencil[1]) - sheet_.points.col(stencil[0])).norm();
    return (best.point - first.point).norm() < farthest * edge ? best : first;
}

Points inflated(const Problem& problem, const Points& start, const Progress& progress) {
    const Inflation inflation(problem, progress);
    Points points = start;
    if (!inflation.ready()) return points;
    for (int k = 0; k < most_iterations; ++k) {
        progress.report(static_cast<double>(k) / most_iterations, "inflation");
        if (inflation.round(points) < converged) break;
    }
    return points.allFinite() ? points : start;
}

Problem on_patch(const Problem& problem, const Patch& patch) {
    return {patch, problem.fixed_points,   problem.fixed_normals, uniform_weights(patch), problem.options,
            0,     problem.normal_weights, problem.free_edge};
}

Sheet resampled(const SolvedSheet& solved, const ProxyMesh::Snapshot& later) {
    const TargetSurface target(solved.mesh.patch, solved.sheet.points, solved.sheet.normals);
    const Lift lift(solved.mesh.patch, solved.sheet);
    const Indices triangle = triangles_nearby(solved, later.patch, target);
    Sheet sheet{later.points, Points(3, later.patch.vertex_count())};
    const Eigen::Index fixed = later.patch.vertex_count() - later.patch.free_count;
    sheet.normals.rightCols(fixed) = solved.sheet.normals.rightCols(fixed);
    for (int v = 0; v < later.patch.free_count; ++v) {
        const SurfaceSample sample = lift.sample(target, target.project(later.points.col(v), triangle[v]));
        sheet.points.col(v) = sample.point;
        sheet.normals.col(v) = sample.normal;
    }
    return sheet;
}

SolvedSheet solve_on(ProxyMesh& mesh, const Problem& problem, const std::optional<SolvedSheet>& last, Measure measure,
                     const NewtonLimits& limits, const Progress& progress) {
    auto snapshot = mesh.snapshot();
    const Problem here = on_patch(problem, snapshot.patch);
    Sheet sheet = last ? resampled(*last, snapshot)
                       : Sheet{snapshot.points, fitted_normals(here, snapshot.points, measure, progress.here())};
    undo_drift(here, sheet);
    const VariationEnergy energy(here, Moving::points_and_normals, measure);
    const NewtonResult result = minimise(energy, sheet, limits, progress);
    mesh.read_back(snapshot.patch, sheet.points);
    return {std::move(snapshot), std::move(sheet), result};
}

}  // namespace fairing
