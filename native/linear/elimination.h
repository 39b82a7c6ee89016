// Symbolic part of a sparse Cholesky factorisation: ordering, elimination tree, supernodes (Davis 2006, ch. 4; Liu
// 1990).
#pragma once

#include <Eigen/SparseCore>

#include "base/types.h"

namespace fairing {

using SparseMatrix = Eigen::SparseMatrix<double>;

// Columns first[s] … first[s + 1] − 1 of the factor share the row structure rows[row_begin[s]] … (sorted, the
// supernode's own columns first). Supernodes are in postorder: children before parents.
struct Supernodes {
    Indices first;
    Indices row_begin;
    Indices rows;
    Indices parent;  // `none` at roots
    Indices column_to_supernode;

    [[nodiscard]] int size() const { return static_cast<int>(first.size()) - 1; }
    [[nodiscard]] int column_count(int s) const { return first[index(s) + 1] - first[index(s)]; }
    [[nodiscard]] int row_count(int s) const { return row_begin[index(s) + 1] - row_begin[index(s)]; }
    [[nodiscard]] const int* row_list(int s) const { return rows.data() + row_begin[index(s)]; }

private:
    static std::size_t index(int s) { return static_cast<std::size_t>(s); }
};

struct Elimination {
    Indices order;     // position in the factor → row of the matrix
    Indices position;  // its inverse
    Supernodes supernodes;
};

// `lower`: lower triangle of a symmetric matrix, diagonal included. The given order (position → unknown) is refined by
// a postorder of the tree, so that supernodes are contiguous; small ones are merged where that adds few zeros.
Elimination analyse(const SparseMatrix& lower, const Indices& first_order);

// Approximate minimum degree.
Indices minimum_degree(const SparseMatrix& lower);

}  // namespace fairing
