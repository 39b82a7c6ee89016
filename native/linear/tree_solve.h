// Solves with a multifrontal factorisation: once up the tree of fronts and once down again, in whole or in part.
#pragma once

#include "base/parallel.h"
#include "linear/front_tree.h"

namespace fairing {

// Fronts that some unknowns belong to, and all above them: those that the upward sweep of a right-hand side with no
// other entries needs, and the downward sweep of a solution wanted only there.
class FrontReach {
public:
    FrontReach() = default;  // all fronts
    // `positions`: of the unknowns in the factor.
    FrontReach(const FrontTree& tree, const Indices& positions);
    [[nodiscard]] bool has(int supernode) const { return marks_.empty() || marks_[supernode] != 0; }

private:
    std::vector<char> marks_;
};

// What a front does to its rows of the right-hand sides, b: an Eigen::Map<Field>, row_count × k, its own rows on top.
template <typename Up, typename Down>
struct FrontSweeps {
    Up up;      // up(supernode, b): eliminates its own; where zeros were below leaves what is to be added there
    Down down;  // down(supernode, b): finds the solution below, and puts its own on top
};
template <typename Up, typename Down>
FrontSweeps(Up, Down) -> FrontSweeps<Up, Down>;  // clang 14 deduces no aggregates by itself

// The sweeps over right-hand sides x in the factor's order, Field = VectorX or MatrixXd (n × k).
template <typename Field, typename Sweeps>
class TreeSolve {
public:
    TreeSolve(const FrontTree& tree, const Sweeps& sweeps, Field& x)
        : tree_(tree), sweeps_(sweeps), x_(x), outer_(tree.subtrees().size()) {}

    void up(const FrontReach& reach) {
        const std::vector<Subtree>& parts = tree_.subtrees();
        run_pieces(static_cast<int>(parts.size()), [&](int k) {
            const Subtree& part = parts[k];
            if (!reach.has(part.root())) return;
            outer_[k].setZero(static_cast<Eigen::Index>(tree_.below(part.root()).size()), x_.cols());
            Buffer buffer;
            for (int s = part.begin; s < part.end; ++s) {
                if (reach.has(s)) up(s, buffer, outer_[k]);
            }
        });
        for (std::size_t k = 0; k < parts.size(); ++k) {
            if (!reach.has(parts[k].root())) continue;
            Eigen::Index place = 0;
            for (int row : tree_.below(parts[k].root())) x_.row(row) += outer_[k].row(place++);
        }
        Field unused;
        Buffer buffer;
        for (int s : tree_.top()) {
            if (reach.has(s)) up(s, buffer, unused);
        }
    }

    void down(const FrontReach& reach) {
        const std::vector<Subtree>& parts = tree_.subtrees();
        Buffer top;
        for (auto s = tree_.top().rbegin(); s != tree_.top().rend(); ++s) {
            if (reach.has(*s)) down(*s, top);
        }
        run_pieces(static_cast<int>(parts.size()), [&](int k) {
            Buffer buffer;
            for (int s = parts[k].end; s-- > parts[k].begin;) {
                if (reach.has(s)) down(s, buffer);
            }
        });
    }

private:
    using Buffer = std::vector<typename Field::Scalar>;  // grows to the largest front that a thread meets
    using Rows = Eigen::Map<Field>;

    auto own_rows(int s) { return x_.middleRows(tree_.nodes().first[s], tree_.nodes().column_count(s)); }

    // b of a front, its own rows filled in.
    Rows load(int s, Buffer& buffer) {
        const int rows = tree_.nodes().row_count(s);
        const auto size = static_cast<std::size_t>(rows) * static_cast<std::size_t>(x_.cols());
        if (buffer.size() < size) buffer.resize(size);
        Rows b(buffer.data(), rows, x_.cols());
        b.topRows(tree_.nodes().column_count(s)) = own_rows(s);
        return b;
    }

    // Into `outer` outside the subtree: other subtrees pass to the same rows.
    void up(int s, Buffer& buffer, Field& outer) {
        const int columns = tree_.nodes().column_count(s);
        Rows b = load(s, buffer);
        b.bottomRows(b.rows() - columns).setZero();
        sweeps_.up(s, b);
        own_rows(s) = b.topRows(columns);
        const auto below = tree_.below(s);
        const auto places = tree_.below_in_outer(s);
        Eigen::Index row = columns;
        for (std::size_t k = 0; k < below.size(); ++k, ++row) {
            if (places[k] == none) {
                x_.row(below[k]) += b.row(row);
            } else {
                outer.row(places[k]) += b.row(row);
            }
        }
    }

    void down(int s, Buffer& buffer) {
        const int columns = tree_.nodes().column_count(s);
        Rows b = load(s, buffer);
        Eigen::Index row = columns;
        for (int below : tree_.below(s)) b.row(row++) = x_.row(below);
        sweeps_.down(s, b);
        own_rows(s) = b.topRows(columns);
    }

    const FrontTree& tree_;
    const Sweeps& sweeps_;
    Field& x_;
    std::vector<Field> outer_;  // what each subtree passes on
};

}  // namespace fairing
