#include "bilaplacian.h"

#include <Eigen/Geometry>

#include <vector>

namespace {

using Triplet = Eigen::Triplet<double>;

// −w at (i, j) and (j, i), w on both diagonals.
void add_edge(std::vector<Triplet>& entries, int i, int j, double weight) {
    entries.emplace_back(i, j, -weight);
    entries.emplace_back(j, i, -weight);
    entries.emplace_back(i, i, weight);
    entries.emplace_back(j, j, weight);
}

SparseMatrix assembled(const std::vector<Triplet>& entries, Eigen::Index size) {
    SparseMatrix matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

// The columns of the free vertices, (n, free).
SparseMatrix free_columns(const SparseMatrix& matrix, const Indices& free) {
    SparseMatrix columns(matrix.rows(), free.size());
    columns.reserve(Eigen::VectorXi::Constant(free.size(), 8));
    for (Eigen::Index k = 0; k < free.size(); ++k) {
        for (SparseMatrix::InnerIterator entry(matrix, free[k]); entry; ++entry) {
            columns.insert(entry.row(), k) = entry.value();
        }
    }
    columns.makeCompressed();
    return columns;
}

// The vertices with the free ones at the origin.
Points held_only(Points vertices, const Indices& free) {
    for (const int index : free) {
        vertices.row(index).setZero();
    }
    return vertices;
}

struct Operators {
    SparseMatrix stiffness;
    Eigen::VectorXd mass;
};

Operators make_operators(const Points& vertices, const Triangles& triangles) {
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(vertices.rows());
    std::vector<Triplet> entries;
    entries.reserve(12 * triangles.rows());
    for (const auto& corner : triangles.rowwise()) {
        for (int k = 0; k < 3; ++k) {
            const int i = corner[k];
            const int j = corner[(k + 1) % 3];
            const int apex = corner[(k + 2) % 3];
            const Eigen::Vector3d a = vertices.row(i) - vertices.row(apex);
            const Eigen::Vector3d b = vertices.row(j) - vertices.row(apex);
            const double doubled_area = a.cross(b).norm();
            add_edge(entries, i, j, a.dot(b) / doubled_area);
            mass[apex] += doubled_area / 6;
        }
    }
    return {assembled(entries, vertices.rows()), mass};
}

}  // namespace

System bilaplacian_system(const Points& vertices, const Triangles& triangles, const Indices& free) {
    const Operators operators = make_operators(vertices, triangles);
    const SparseMatrix columns = free_columns(operators.stiffness, free);
    const SparseMatrix scaled = operators.mass.cwiseInverse().asDiagonal() * columns;
    const Points outside = operators.stiffness * held_only(vertices, free);
    return {columns.transpose() * scaled, -(scaled.transpose() * outside)};
}

System membrane_system(const Points& vertices, const Triangles& triangles, const Indices& free) {
    std::vector<Triplet> entries;
    for (const auto& corner : triangles.rowwise()) {
        for (int k = 0; k < 3; ++k) {
            add_edge(entries, corner[k], corner[(k + 1) % 3], 1.0);
        }
    }
    const SparseMatrix columns = free_columns(assembled(entries, vertices.rows()), free);
    SparseMatrix choose(vertices.rows(), free.size());
    choose.reserve(Eigen::VectorXi::Constant(free.size(), 1));
    for (Eigen::Index k = 0; k < free.size(); ++k) {
        choose.insert(free[k], k) = 1.0;
    }
    return {choose.transpose() * columns, -(columns.transpose() * held_only(vertices, free))};
}
