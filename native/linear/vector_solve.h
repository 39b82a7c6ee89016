// Solves with a Cholesky factor for one right-hand side, in whole or in part of the tree of fronts.
#pragma once

#include "linear/front_tree.h"

namespace fairing {

// A factor that lives elsewhere. Panel s: row_count × column_count, column-major, at panels + panel_begin[s].
struct CholeskyFactor {
    const FrontTree& tree;
    const Indices& order;     // position in the factor → row of the matrix
    const Indices& position;  // its inverse
    const double* panels;
    const std::size_t* panel_begin;
};

// Fronts that some unknowns belong to, and all above them: what a right-hand side with no other entries needs on the
// way up, and a solution wanted only there on the way down.
class FrontReach {
public:
    FrontReach() = default;  // all fronts
    FrontReach(const CholeskyFactor& factor, const Indices& unknowns);
    [[nodiscard]] bool has(int supernode) const { return marks_.empty() || marks_[at(supernode)] != 0; }

private:
    std::vector<char> marks_;
};

// x with L Lᵀ x = rhs. `from`: reach of the entries of `rhs` that aren't zero; `to`: where x is wanted, elsewhere it is
// left undefined.
VectorX solve_vector(const CholeskyFactor& factor, const VectorX& rhs, const FrontReach& from, const FrontReach& to);

}  // namespace fairing
