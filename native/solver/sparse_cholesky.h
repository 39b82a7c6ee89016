// Sparse Cholesky factorisation with a fixed pattern and changing values.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "base/progress.h"
#include "base/types.h"

namespace fairing {

using SparseMatrix = Eigen::SparseMatrix<double>;

class SparseCholesky {
public:
    // Factorises a symmetric positive definite matrix given by its lower triangle. The ordering is found at the first
    // call and kept: the pattern must stay the same. Throws SolverError, naming `what`, when the matrix is not definite.
    void factorise(const SparseMatrix& lower, const char* what);

    // Solves for one or several right-hand sides (n × k).
    template <typename Rhs>
    [[nodiscard]] Rhs solve(const Rhs& rhs) const {
        return factor_.solve(rhs);
    }

    [[nodiscard]] bool ready() const { return ready_; }

private:
    Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::AMDOrdering<int>> factor_;
    bool analysed_ = false;
    bool ready_ = false;
};

}  // namespace fairing
