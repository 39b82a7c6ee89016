// Solves with a multifrontal factorisation: once up the tree of fronts and once down again.
#pragma once

#include <functional>

#include "linear/front_tree.h"

namespace fairing {

// The rows of a front's own unknowns in the right-hand sides.
using OwnRows = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

// What a front does to its own rows on either way.
struct FrontSweeps {
    // Up: eliminates; what it returns is taken from the rows below.
    std::function<Eigen::MatrixXd(int supernode, OwnRows& own)> up;
    // Down: `below` holds the solution in the rows below.
    std::function<void(int supernode, OwnRows& own, const Eigen::MatrixXd& below)> down;
};

// `rhs`: n × k, in the matrix's order; `order`: position in the factor → row of the matrix.
Eigen::MatrixXd solve_by_fronts(const FrontTree& tree, const Indices& order, const Eigen::MatrixXd& rhs,
                                const FrontSweeps& sweeps);

}  // namespace fairing
