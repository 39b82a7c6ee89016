#include "texture/harmonic_extension.h"

#include <algorithm>
#include <limits>

#include "base/errors.h"
#include "fairness/intrinsic_delaunay.h"
#include "geometry/cotangent.h"
#include "linear/sparse_cholesky.h"
#include "mesh/edges.h"
#include "mesh/union_find.h"

namespace fairing {

namespace {

bool is_oriented_surface(const Triangles& triangles, const EdgeTable& edges) {
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) > 2) return false;
        if (edges.side_count(e) == 2 &&
            side_tail(triangles, edges.side(e, 0)) == side_tail(triangles, edges.side(e, 1)))
            return false;
    }
    return true;
}

InnerWeights own_weights(const Points& points, const Triangles& triangles, const EdgeTable& edges) {
    InnerWeights weights;
    for (int e = 0; e < edges.size(); ++e) {
        double sum = 0.0;
        for (int k = 0; k < edges.side_count(e); ++k) {
            const int side = edges.side(e, k);
            const Vector3 apex = points.col(triangles((side % 3 + 2) % 3, side / 3));
            sum += cotangent(points.col(edges.ends[e][0]) - apex, points.col(edges.ends[e][1]) - apex);
        }
        weights.push_back({edges.ends[e][0], edges.ends[e][1], std::max(sum, least_harmonic_weight)});
    }
    return weights;
}

InnerWeights weights_of(const Points& points, const Triangles& triangles) {
    const EdgeTable edges = make_edges(triangles, static_cast<int>(points.cols()));
    if (!is_oriented_surface(triangles, edges)) return own_weights(points, triangles, edges);
    IntrinsicTriangulation intrinsic(triangles, points);
    intrinsic.make_delaunay();
    return intrinsic.cotangent_weights();
}

// Each vertex's number among those to be found; `none` where it is known, or hangs together with no known one.
Indices numbered(Eigen::Index count, const InnerWeights& weights, const Indices& known) {
    UnionFind pieces(static_cast<int>(count));
    for (const WeightedEdge& edge : weights) pieces.join(edge.i, edge.j);
    std::vector<char> is_reached(count, 0);
    for (const int v : known) is_reached[pieces.root(v)] = 1;
    std::vector<char> is_known(count, 0);
    for (const int v : known) is_known[v] = 1;
    Indices number(count, none);
    int free_count = 0;
    for (int v = 0; v < static_cast<int>(count); ++v) {
        if (is_known[v] == 0 && is_reached[pieces.root(v)] != 0) number[v] = free_count++;
    }
    return number;
}

}  // namespace

Eigen::MatrixXd harmonic_extension(const Points& points, const Triangles& triangles, const Indices& known,
                                   const Eigen::MatrixXd& given) {
    Eigen::MatrixXd values =
        Eigen::MatrixXd::Constant(points.cols(), given.cols(), std::numeric_limits<double>::quiet_NaN());
    for (int k = 0; k < static_cast<int>(known.size()); ++k) values.row(known[k]) = given.row(k);
    const InnerWeights weights = weights_of(points, triangles);
    const Indices number = numbered(points.cols(), weights, known);
    const int count = number.empty() ? 0 : *std::max_element(number.begin(), number.end()) + 1;
    if (count == 0) return values;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(count, given.cols());
    const auto add = [&](int row, int column, double weight) {
        if (number[row] == none) return;
        entries.emplace_back(number[row], number[row], weight);
        if (number[column] == none)
            rhs.row(number[row]) += weight * values.row(column);
        else if (number[column] < number[row])
            entries.emplace_back(number[row], number[column], -weight);
    };
    for (const WeightedEdge& edge : weights) {
        add(edge.i, edge.j, edge.weight);
        add(edge.j, edge.i, edge.weight);
    }
    SparseMatrix lower(count, count);
    lower.setFromTriplets(entries.begin(), entries.end());
    Points places(3, count);
    for (int v = 0; v < static_cast<int>(points.cols()); ++v) {
        if (number[v] != none) places.col(number[v]) = points.col(v);
    }
    SparseCholesky factor(places);
    if (!factor.factorise(std::move(lower), "colours", Progress()))
        throw SolverError("the values could not be continued: the mesh has triangles without area");
    const Eigen::MatrixXd found = factor.solve(rhs);
    for (int v = 0; v < static_cast<int>(points.cols()); ++v) {
        if (number[v] != none) values.row(v) = found.row(number[v]);
    }
    return values;
}

}  // namespace fairing
