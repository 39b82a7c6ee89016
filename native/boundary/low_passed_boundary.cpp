#include "boundary/low_passed_boundary.h"

#include <Eigen/SparseCholesky>

#include "fairness/harmonic_values.h"
#include "geometry/limits.h"
#include "geometry/neighbourhood.h"
#include "linear/elimination.h"
#include "mesh/fans.h"

namespace fairing {

namespace {

// 1 + μ δ²ᵀ δ² of a closed run, δ² x_i = x_{i−1} − 2 x_i + x_{i+1}. A wave of w vertices shrinks by
// 1 + 16 μ sin⁴(π/w).
SparseMatrix low_pass(int count, double wave) {
    const double stiffness = 1.0 / (16.0 * std::pow(std::sin(std::numbers::pi / wave), 4));
    std::vector<Eigen::Triplet<double>> entries;
    for (int k = 0; k < count; ++k) {
        entries.emplace_back(k, k, -2.0);
        entries.emplace_back(k, (k + 1) % count, 1.0);
        entries.emplace_back(k, (k + count - 1) % count, 1.0);
    }
    SparseMatrix differences(count, count);
    differences.setFromTriplets(entries.begin(), entries.end());
    SparseMatrix result = stiffness * SparseMatrix(differences.transpose() * differences);
    for (int k = 0; k < count; ++k) result.coeffRef(k, k) += 1.0;
    return result;
}

// Unit vectors at right angles to the chords of a closed run's neighbours; `otherwise` where nothing is left.
Points across(const Points& curve, const Points& normals, const Points& otherwise) {
    constexpr double least = 1e-3;  // below, the normal lies along the curve and says nothing
    const Eigen::Index count = curve.cols();
    Points result = otherwise;
    for (Eigen::Index k = 0; k < count; ++k) {
        const Vector3 along = (curve.col((k + 1) % count) - curve.col((k + count - 1) % count)).stableNormalized();
        const Vector3 n = normals.col(k) - normals.col(k).dot(along) * along;
        if (n.norm() > least) result.col(k) = n.normalized();
    }
    return result;
}

double mean_edge_of(const Patch& patch, const BoundaryData& boundary, const Indices& loop) {
    double sum = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const int next = loop[(k + 1) % loop.size()];
        sum += (boundary.points.col(next - patch.free_count) - boundary.points.col(loop[k] - patch.free_count)).norm();
    }
    return sum / static_cast<double>(loop.size());
}

}  // namespace

double boundary_variation(const Patch& patch, const BoundaryData& boundary) {
    double sum = 0.0;
    for (const Indices& loop : patch.loops()) {
        const double least = std::pow(least_reported * mean_edge_of(patch, boundary, loop), 4.0);
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const int a = loop[k] - patch.free_count;
            const int b = loop[(k + 1) % loop.size()] - patch.free_count;
            const Vector3 edge = boundary.points.col(b) - boundary.points.col(a);
            const double turn = (boundary.normals.col(a) + boundary.normals.col(b)).dot(edge);
            const double fourth = edge.squaredNorm() * edge.squaredNorm();
            if (fourth > least) sum += 36.0 * turn * turn / fourth;
        }
    }
    return sum;
}

BoundaryData low_passed_boundary(const Patch& patch, const BoundaryData& boundary, double wave) {
    BoundaryData result = boundary;
    for (Indices loop : patch.loops()) {
        if (static_cast<double>(loop.size()) <= wave) continue;
        for (int& v : loop) v -= patch.free_count;
        const Eigen::SimplicialLDLT<SparseMatrix> factor(low_pass(static_cast<int>(loop.size()), wave));
        const Points given = boundary.normals(Eigen::all, loop);
        const Points points = factor.solve(boundary.points(Eigen::all, loop).transpose()).transpose();
        const Points normals = factor.solve(given.transpose()).transpose();
        result.points(Eigen::all, loop) = points;
        result.normals(Eigen::all, loop) = across(points, normals, given);
    }
    return result;
}

Points closing_surface(const Points& points, const Triangles& triangles, const std::vector<char>& held) {
    const VertexAdjacency around(triangles, static_cast<int>(points.cols()));
    InnerWeights edges;
    for (int v = 0; v < static_cast<int>(points.cols()); ++v) {
        for (int k = around.begin[v]; k < around.begin[v + 1]; ++k) {
            if (around.neighbours[k] < v) edges.push_back({v, around.neighbours[k], 1.0});
        }
    }
    const auto found = harmonic_values({edges, held, points}, points.transpose());
    return found ? Points(found->transpose()) : points;
}

BrokenSurface broken_along(const Triangles& triangles, int vertex_count, const std::vector<std::array<int, 2>>& edges) {
    const EdgeTable table = make_edges(triangles, vertex_count);
    std::vector<char> cut(table.size(), 0);
    for (const auto& [a, b] : edges) {
        const std::array wanted{std::min(a, b), std::max(a, b)};
        const auto found = std::lower_bound(table.ends.begin(), table.ends.end(), wanted);
        if (found != table.ends.end() && *found == wanted)
            cut[static_cast<std::size_t>(found - table.ends.begin())] = 1;
    }
    const Fans fans = join_corners(triangles, twins_across(table, cut));
    BrokenSurface result{Triangles(3, triangles.cols()), fans.input_vertex};
    for (Eigen::Index c = 0; c < triangles.size(); ++c)
        result.triangles(c % 3, c / 3) = fans.of_corner[static_cast<std::size_t>(c)];
    return result;
}

}  // namespace fairing
