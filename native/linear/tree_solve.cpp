#include "linear/tree_solve.h"

#include "base/parallel.h"

namespace fairing {

namespace {

class Sweep {
public:
    Sweep(const FrontTree& tree, const FrontSweeps& sweeps, Eigen::MatrixXd& x)
        : tree_(tree), sweeps_(sweeps), x_(x), outer_(tree.subtrees().size()) {}

    void up() {
        const std::vector<Subtree>& parts = tree_.subtrees();
        run_pieces(static_cast<int>(parts.size()), [&](int k) {
            const Subtree& part = parts[at(k)];
            outer_[at(k)].setZero(static_cast<Eigen::Index>(tree_.below(part.root()).size()), x_.cols());
            for (int s = part.begin; s < part.end; ++s) up(s, outer_[at(k)]);
        });
        for (std::size_t k = 0; k < parts.size(); ++k) {
            Eigen::Index place = 0;
            for (int row : tree_.below(parts[k].root())) x_.row(row) += outer_[k].row(place++);
        }
        Eigen::MatrixXd unused;
        for (int s : tree_.top()) up(s, unused);
    }

    void down() {
        const std::vector<Subtree>& parts = tree_.subtrees();
        for (auto s = tree_.top().rbegin(); s != tree_.top().rend(); ++s) down(*s);
        run_pieces(static_cast<int>(parts.size()), [&](int k) {
            for (int s = parts[at(k)].end; s-- > parts[at(k)].begin;) down(s);
        });
    }

private:
    OwnRows own_rows(int s) { return x_.middleRows(tree_.nodes().first[at(s)], tree_.nodes().column_count(s)); }

    // Into `outer` outside the subtree: other subtrees pass to the same rows.
    void up(int s, Eigen::MatrixXd& outer) {
        OwnRows own = own_rows(s);
        const Eigen::MatrixXd passed = sweeps_.up(s, own);
        const auto rows = tree_.below(s);
        const auto places = tree_.below_in_outer(s);
        for (Eigen::Index k = 0; k < passed.rows(); ++k) {
            const int place = places[std::size_t(k)];
            if (place == none) {
                x_.row(rows[std::size_t(k)]) -= passed.row(k);
            } else {
                outer.row(place) -= passed.row(k);
            }
        }
    }

    void down(int s) {
        const auto rows = tree_.below(s);
        Eigen::MatrixXd below(static_cast<Eigen::Index>(rows.size()), x_.cols());
        for (Eigen::Index k = 0; k < below.rows(); ++k) below.row(k) = x_.row(rows[std::size_t(k)]);
        OwnRows own = own_rows(s);
        sweeps_.down(s, own, below);
    }

    const FrontTree& tree_;
    const FrontSweeps& sweeps_;
    Eigen::MatrixXd& x_;
    std::vector<Eigen::MatrixXd> outer_;  // what each subtree passes on
};

}  // namespace

Eigen::MatrixXd solve_by_fronts(const FrontTree& tree, const Indices& order, const Eigen::MatrixXd& rhs,
                                const FrontSweeps& sweeps) {
    Eigen::MatrixXd x(rhs.rows(), rhs.cols());
    for (std::size_t k = 0; k < order.size(); ++k) x.row(static_cast<Eigen::Index>(k)) = rhs.row(order[k]);
    Sweep sweep(tree, sweeps, x);
    sweep.up();
    sweep.down();
    Eigen::MatrixXd result(rhs.rows(), rhs.cols());
    for (std::size_t k = 0; k < order.size(); ++k) result.row(order[k]) = x.row(static_cast<Eigen::Index>(k));
    return result;
}

}  // namespace fairing
