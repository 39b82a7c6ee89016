#include "fairness/harmonic_values.h"

#include "geometry/face_geometry.h"
#include "geometry/triangle.h"
#include "linear/sparse_cholesky.h"
#include "mesh/union_find.h"

namespace fairing {

namespace {

// A known value next to one that isn't: far from the origin differences from it have more digits.
Eigen::RowVectorXd one_known(const HarmonicProblem& problem, const Eigen::MatrixXd& values) {
    const auto& known = problem.is_known;
    const auto at = std::ranges::find_if(problem.edges, [&](const auto& e) { return known[e.i] != known[e.j]; });
    return values.row(known[at->i] ? at->i : at->j);
}

// Vertices to be found: not known, but together with one that is.
Indices to_find(const InnerWeights& edges, const std::vector<char>& is_known) {
    const auto count = static_cast<int>(is_known.size());
    UnionFind pieces(count);
    for (const WeightedEdge& edge : edges) pieces.join(edge.i, edge.j);
    std::vector<char> is_reached(is_known.size(), 0);
    for (int v = 0; v < count; ++v) {
        if (is_known[v]) is_reached[pieces.root(v)] = 1;
    }
    Indices found;
    for (int v = 0; v < count; ++v) {
        if (!is_known[v] && is_reached[pieces.root(v)]) found.push_back(v);
    }
    return found;
}

}  // namespace

std::optional<Eigen::MatrixXd> harmonic_values(const HarmonicProblem& problem, Eigen::MatrixXd values) {
    const Indices wanted = to_find(problem.edges, problem.is_known);
    if (wanted.empty()) return values;
    Indices row(problem.is_known.size(), none);
    for (std::size_t k = 0; k < wanted.size(); ++k) row[wanted[k]] = static_cast<int>(k);
    const auto count = static_cast<Eigen::Index>(wanted.size());
    const Eigen::RowVectorXd centre = one_known(problem, values);
    Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(count, values.cols());
    if (problem.sources.size() > 0) rhs = problem.sources(wanted, Eigen::all);
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](int v, int other, double weight) {
        if (row[v] == none) return;
        entries.emplace_back(row[v], row[v], weight);
        if (row[other] == none)
            rhs.row(row[v]) += weight * (values.row(other) - centre);
        else if (row[other] < row[v])
            entries.emplace_back(row[v], row[other], -weight);
    };
    for (const auto& [i, j, weight] : problem.edges) {
        add(i, j, weight);
        add(j, i, weight);
    }
    SparseMatrix lower(count, count);
    lower.setFromTriplets(entries.begin(), entries.end());
    SparseCholesky factor(problem.places.cols() > 0 ? Points(problem.places(Eigen::all, wanted)) : Points(3, 0));
    if (!factor.factorise(std::move(lower), "values", Progress())) return std::nullopt;
    values(wanted, Eigen::all) = factor.solve(rhs).rowwise() + centre;
    return values;
}

InnerWeights harmonic_weights(const Patch& patch, const Points& points) {
    Stiffness stiffness(patch, points);
    InnerWeights edges;
    for (int e = 0; e < patch.edge_count(); ++e) {
        const auto [a, b] = patch.edge_ends[e];
        edges.push_back({a, b, std::max(least_harmonic_weight, stiffness.weights[e])});
    }
    return edges;
}

std::optional<Eigen::MatrixXd> harmonic_values(const Patch& patch, const Points& points, const Eigen::MatrixXd& given) {
    std::vector<char> is_known(static_cast<std::size_t>(patch.vertex_count()), 1);
    std::fill_n(is_known.begin(), patch.free_count, 0);
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(patch.vertex_count(), given.cols());
    values.bottomRows(given.rows()) = given;
    auto found = harmonic_values({harmonic_weights(patch, points), std::move(is_known), points}, std::move(values));
    if (found) found->conservativeResize(patch.free_count, Eigen::NoChange);
    return found;
}

}  // namespace fairing
