#include "boundary/closing.h"

#include <vector>

#include "geometry/neighbourhood.h"
#include "linear/sparse_cholesky.h"

namespace fairing {

namespace {

// Of the diagonal: pieces without a boundary have a place then, too.
constexpr double anchoring = 1e-12;

// Vertices of triangles, held or free, numbered within each kind.
struct Members {
    Indices held;
    Indices free;
    Indices number;  // of a free vertex
};

Members members_of(const VertexAdjacency& around, const std::vector<char>& held) {
    Members members{{}, {}, Indices(held.size(), none)};
    for (int v = 0; v < static_cast<int>(held.size()); ++v) {
        if (around.begin[v] == around.begin[v + 1]) continue;
        if (!held[v]) members.number[v] = static_cast<int>(members.free.size());
        (held[v] ? members.held : members.free).push_back(v);
    }
    return members;
}

// The lower triangle of the graph's Laplacian at the free vertices. `pull`: of what is held, from the centre.
SparseMatrix laplacian(const VertexAdjacency& around, const Members& members, const Points& from_centre, Points& pull) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int row = 0; row < static_cast<int>(members.free.size()); ++row) {
        const int v = members.free[row];
        const int degree = around.begin[v + 1] - around.begin[v];
        entries.emplace_back(row, row, (1.0 + anchoring) * degree);
        for (int k = around.begin[v]; k < around.begin[v + 1]; ++k) {
            const int column = members.number[around.neighbours[k]];
            if (column == none) pull.col(row) += from_centre.col(around.neighbours[k]);
            if (column != none && column < row) entries.emplace_back(row, column, -1.0);
        }
    }
    const auto count = static_cast<Eigen::Index>(members.free.size());
    SparseMatrix lower(count, count);
    lower.setFromTriplets(entries.begin(), entries.end());
    return lower;
}

}  // namespace

Points closing_surface(const Points& points, const Triangles& triangles, const std::vector<char>& held) {
    const VertexAdjacency around(triangles, static_cast<int>(points.cols()));
    const Members members = members_of(around, held);
    if (members.held.empty() || members.free.empty()) return points;
    const Vector3 centre = points(Eigen::all, members.held).rowwise().mean();
    Points pull = Points::Zero(3, static_cast<Eigen::Index>(members.free.size()));
    SparseCholesky factor(points(Eigen::all, members.free));
    if (!factor.factorise(laplacian(around, members, points.colwise() - centre, pull), "boundary normals", Progress()))
        return points;
    Points result = points;
    result(Eigen::all, members.free) = factor.solve_points(pull).colwise() + centre;
    return result;
}

}  // namespace fairing
