// Sparse LU factorisation of diagonally dominant matrices that are not symmetric: multifrontal over the pattern of
// A + Aᵀ, interruptible between any two fronts.
#pragma once

#include <Eigen/LU>

#include "base/progress.h"
#include "linear/front_tree.h"

namespace fairing {

class SparseLu {
public:
    // Pivots are chosen within a front only: enough where the diagonal dominates each row. False where that leaves a
    // singular front; the factor is then unusable, as it is after Cancelled. `what` names the stage for `progress`.
    [[nodiscard]] bool factorise(const SparseMatrix& matrix, const char* what, const Progress& progress);

    // Solves for one or several right-hand sides (n × k).
    [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const;

private:
    // [D U; B ·] with D of the front's own unknowns: the upward sweep computes x ← D⁻¹x, and B carries it to the rows
    // below.
    struct Front {
        Eigen::PartialPivLU<Eigen::MatrixXd> pivot;  // of D
        Eigen::MatrixXd lower;                       // B
        Eigen::MatrixXd upper;                       // D⁻¹U
        Eigen::MatrixXd update;                      // −B D⁻¹U and the children's, freed once the parent has added it
    };

    [[nodiscard]] Eigen::MatrixXd gather(int supernode, const SparseMatrix& matrix, const SparseMatrix& transposed);
    [[nodiscard]] bool eliminate(int supernode, const Eigen::MatrixXd& front);

    Indices order_;  // position in the factor → row of the matrix
    Indices position_;
    FrontTree tree_;
    std::vector<Front> fronts_;
};

}  // namespace fairing
