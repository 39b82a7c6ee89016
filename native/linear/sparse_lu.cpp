#include "linear/sparse_lu.h"

#include <atomic>

#include "base/parallel.h"
#include "linear/limits.h"
#include "linear/tree_solve.h"

namespace fairing {

namespace {

// Where a position of the factor stands in the row list of a supernode that has it.
Eigen::Index place_in(const Supernodes& nodes, int s, int position) {
    const int* const rows = nodes.row_list(s);
    return std::lower_bound(rows, rows + nodes.row_count(s), position) - rows;
}

}  // namespace

// The front's own rows and columns of the matrix, and what its children pass on.
Eigen::MatrixXd SparseLu::gather(int s, const SparseMatrix& matrix, const SparseMatrix& transposed) {
    const Supernodes& nodes = tree_.nodes();
    Eigen::MatrixXd front = Eigen::MatrixXd::Zero(nodes.row_count(s), nodes.row_count(s));
    const int begin = nodes.first[s];
    const int end = nodes.first[s + 1];
    for (int own = begin; own < end; ++own) {
        for (SparseMatrix::InnerIterator entry(matrix, order_[own]); entry; ++entry) {
            const int row = position_[static_cast<int>(entry.row())];
            if (row >= begin) front(place_in(nodes, s, row), own - begin) = entry.value();
        }
        for (SparseMatrix::InnerIterator entry(transposed, order_[own]); entry; ++entry) {
            const int column = position_[static_cast<int>(entry.row())];
            if (column >= end) front(own - begin, place_in(nodes, s, column)) = entry.value();
        }
    }
    for (int child : tree_.children(s)) {
        Eigen::MatrixXd& update = fronts_[child].update;
        const auto places = tree_.below_in_parent(child);
        for (Eigen::Index b = 0; b < update.cols(); ++b) {
            for (Eigen::Index a = 0; a < update.rows(); ++a) {
                front(places[std::size_t(a)], places[std::size_t(b)]) += update(a, b);
            }
        }
        update.resize(0, 0);
    }
    return front;
}

// False where the front is singular.
bool SparseLu::eliminate(int s, const Eigen::MatrixXd& front) {
    Front& result = fronts_[s];
    const Eigen::Index own = tree_.nodes().column_count(s);
    const Eigen::Index below = front.rows() - own;
    result.pivot.compute(front.topLeftCorner(own, own));
    const double least = result.pivot.matrixLU().diagonal().cwiseAbs().minCoeff();
    if (!(least > 0.0)) return false;
    result.lower = front.bottomLeftCorner(below, own);
    result.upper.resize(own, below);
    result.update = front.bottomRightCorner(below, below);
    for_ranges(static_cast<int>(below), tile, [&](int first, int last) {
        const auto columns = Eigen::seqN(first, last - first);
        result.upper(Eigen::all, columns) = result.pivot.solve(front.topRightCorner(own, below)(Eigen::all, columns));
        result.update(Eigen::all, columns).noalias() -= result.lower * result.upper(Eigen::all, columns);
    });
    return true;
}

bool SparseLu::factorise(const SparseMatrix& matrix, const char* what, const Progress& progress) {
    progress.report(0.0, what);
    const SparseMatrix transposed = matrix.transpose();
    const SparseMatrix both = matrix + transposed;
    const SparseMatrix lower = both.triangularView<Eigen::Lower>();
    Elimination elimination = analyse(lower, minimum_degree(lower));
    order_ = std::move(elimination.order);
    position_ = std::move(elimination.position);
    tree_ = FrontTree(std::move(elimination.supernodes));
    fronts_.assign(tree_.nodes().size(), {});
    std::atomic<bool> regular = true;
    const auto eliminate_if_regular = [&](int s) {
        if (regular && !eliminate(s, gather(s, matrix, transposed))) regular = false;
        checkpoint();
    };
    run_pieces(static_cast<int>(tree_.subtrees().size()), [&](int k) {
        const Subtree& part = tree_.subtrees()[k];
        for (int s = part.begin; s < part.end; ++s) eliminate_if_regular(s);
    });
    for (int s : tree_.top()) eliminate_if_regular(s);
    return regular;
}

Eigen::MatrixXd SparseLu::solve(const Eigen::MatrixXd& rhs) const {
    using Rows = Eigen::Map<Eigen::MatrixXd>;
    const auto up = [this](int s, Rows& b) {
        const Front& front = fronts_[s];
        auto own = b.topRows(front.upper.rows());
        own = front.pivot.solve(own).eval();
        b.bottomRows(front.lower.rows()).noalias() -= front.lower * own;
    };
    const auto down = [this](int s, Rows& b) {
        const Front& front = fronts_[s];
        b.topRows(front.upper.rows()).noalias() -= front.upper * b.bottomRows(front.lower.rows());
    };
    return solve_by_fronts(tree_, order_, rhs, FrontSweeps{up, down});
}

}  // namespace fairing
