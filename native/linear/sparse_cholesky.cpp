#include "linear/sparse_cholesky.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "linear/nested_dissection.h"

namespace fairing {

namespace {

// Below, minimum degree leaves as little fill.
constexpr Eigen::Index least_dissected = 5000;

}  // namespace

Eigen::Map<Eigen::MatrixXd> SparseCholesky::panel(int s) {
    const Supernodes& nodes = elimination_.supernodes;
    return {panels_.data() + panel_begin_[at(s)], nodes.row_count(s), nodes.column_count(s)};
}

Eigen::Map<const Eigen::MatrixXd> SparseCholesky::panel(int s) const {
    const Supernodes& nodes = elimination_.supernodes;
    return {panels_.data() + panel_begin_[at(s)], nodes.row_count(s), nodes.column_count(s)};
}

void SparseCholesky::set_up(const SparseMatrix& lower) {
    const bool dissect = layout_.cols() == lower.cols() && lower.cols() >= least_dissected;
    elimination_ = analyse(lower, dissect ? nested_dissection(lower, layout_) : minimum_degree(lower));
    const Supernodes& nodes = elimination_.supernodes;
    panel_begin_ = {0};
    for (int s = 0; s < nodes.size(); ++s) {
        panel_begin_.push_back(panel_begin_.back() + at(nodes.row_count(s)) * at(nodes.column_count(s)));
    }
    panels_.resize(panel_begin_.back());
    updates_.resize(at(nodes.size()));
    local_row_.assign(elimination_.order.size(), none);

    children_begin_.assign(at(nodes.size()) + 1, 0);
    for (int p : nodes.parent) {
        if (p != none) ++children_begin_[at(p) + 1];
    }
    for (std::size_t s = 1; s < children_begin_.size(); ++s) children_begin_[s] += children_begin_[s - 1];
    children_.resize(at(children_begin_.back()));
    Indices cursor(children_begin_.begin(), children_begin_.end());
    for (int s = 0; s < nodes.size(); ++s) {
        if (nodes.parent[at(s)] != none) children_[at(cursor[at(nodes.parent[at(s)])]++)] = s;
    }

    entry_slot_.reserve(at(static_cast<int>(lower.nonZeros())));
    for (int j = 0; j < lower.cols(); ++j) {
        for (SparseMatrix::InnerIterator entry(lower, j); entry; ++entry) {
            const int a = elimination_.position[at(static_cast<int>(entry.row()))];
            const int b = elimination_.position[at(j)];
            const int column = std::min(a, b);
            const int s = nodes.column_to_supernode[at(column)];
            const int* rows = nodes.row_list(s);
            const auto row = std::lower_bound(rows, rows + nodes.row_count(s), std::max(a, b)) - rows;
            const auto local_column = static_cast<std::size_t>(column - nodes.first[at(s)]);
            entry_slot_.push_back(panel_begin_[at(s)] + local_column * at(nodes.row_count(s)) +
                                  static_cast<std::size_t>(row));
        }
    }
    analysed_ = true;
}

void SparseCholesky::scatter(const SparseMatrix& lower) {
    std::fill(panels_.begin(), panels_.end(), 0.0);
    auto slot = entry_slot_.begin();
    for (int j = 0; j < lower.cols(); ++j) {
        for (SparseMatrix::InnerIterator entry(lower, j); entry; ++entry) panels_[*slot++] += entry.value();
    }
}

// Adds what a child passes on to the panel of its parent and to what the parent passes on itself (lower triangles).
void SparseCholesky::add_child(int child, int parent, Eigen::MatrixXd& parent_update) {
    const Supernodes& nodes = elimination_.supernodes;
    Eigen::MatrixXd& update = updates_[at(child)];
    const int* rows = nodes.row_list(child) + nodes.column_count(child);
    const int columns = nodes.column_count(parent);
    auto front = panel(parent);
    for (Eigen::Index b = 0; b < update.cols(); ++b) {
        const int column = local_row_[at(rows[b])];
        if (column < columns) {
            for (Eigen::Index a = b; a < update.rows(); ++a) front(local_row_[at(rows[a])], column) += update(a, b);
        } else {
            for (Eigen::Index a = b; a < update.rows(); ++a) {
                parent_update(local_row_[at(rows[a])] - columns, column - columns) += update(a, b);
            }
        }
    }
    update.resize(0, 0);
}

// Dense factorisation of one front; false where a pivot is not positive.
bool SparseCholesky::eliminate(int s) {
    const Supernodes& nodes = elimination_.supernodes;
    const int columns = nodes.column_count(s);
    const int below = nodes.row_count(s) - columns;
    const int* rows = nodes.row_list(s);
    for (int k = 0; k < nodes.row_count(s); ++k) local_row_[at(rows[k])] = k;
    Eigen::MatrixXd& update = updates_[at(s)];
    update.setZero(below, below);
    for (int c = children_begin_[at(s)]; c < children_begin_[at(s) + 1]; ++c) add_child(children_[at(c)], s, update);

    auto front = panel(s);
    auto diagonal = front.topRows(columns);
    Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(diagonal);
    if (llt.info() != Eigen::Success) return false;
    if (below == 0) return true;
    auto lower = front.bottomRows(below);
    diagonal.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(lower);
    update.selfadjointView<Eigen::Lower>().rankUpdate(lower, -1.0);
    return true;
}

bool SparseCholesky::factorise(const SparseMatrix& lower, const char* what, const Progress& progress) {
    progress.report(0.0, what);
    if (!analysed_) set_up(lower);
    scatter(lower);
    // Asked about every ten million operations of the dense kernels.
    constexpr double operations_between_reports = 1e7;
    double operations = 0.0;
    const Supernodes& nodes = elimination_.supernodes;
    for (int s = 0; s < nodes.size(); ++s) {
        if (!eliminate(s)) return false;
        const double rows = nodes.row_count(s);
        operations += rows * rows * nodes.column_count(s);
        if (operations > operations_between_reports) {
            operations = 0.0;
            progress.report(static_cast<double>(panel_begin_[at(s)]) / static_cast<double>(panels_.size()), what);
        }
    }
    return true;
}

Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& rhs) const {
    const Supernodes& nodes = elimination_.supernodes;
    Eigen::MatrixXd x(rhs.rows(), rhs.cols());
    for (std::size_t k = 0; k < elimination_.order.size(); ++k) {
        x.row(static_cast<Eigen::Index>(k)) = rhs.row(elimination_.order[k]);
    }
    Eigen::MatrixXd below;
    for (int s = 0; s < nodes.size(); ++s) {
        const int columns = nodes.column_count(s);
        const auto front = panel(s);
        auto own = x.middleRows(nodes.first[at(s)], columns);
        front.topRows(columns).triangularView<Eigen::Lower>().solveInPlace(own);
        const int* rows = nodes.row_list(s) + columns;
        below.noalias() = front.bottomRows(front.rows() - columns) * own;
        for (Eigen::Index k = 0; k < below.rows(); ++k) x.row(rows[k]) -= below.row(k);
    }
    for (int s = nodes.size() - 1; s >= 0; --s) {
        const int columns = nodes.column_count(s);
        const auto front = panel(s);
        const int* rows = nodes.row_list(s) + columns;
        below.resize(front.rows() - columns, rhs.cols());
        for (Eigen::Index k = 0; k < below.rows(); ++k) below.row(k) = x.row(rows[k]);
        auto own = x.middleRows(nodes.first[at(s)], columns);
        own.noalias() -= front.bottomRows(front.rows() - columns).transpose() * below;
        front.topRows(columns).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
    }
    Eigen::MatrixXd result(rhs.rows(), rhs.cols());
    for (std::size_t k = 0; k < elimination_.order.size(); ++k) {
        result.row(elimination_.order[k]) = x.row(static_cast<Eigen::Index>(k));
    }
    return result;
}

}  // namespace fairing
