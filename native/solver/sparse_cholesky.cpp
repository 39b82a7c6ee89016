#include "solver/sparse_cholesky.h"

#include <string>

#include "base/errors.h"

namespace fairing {

void SparseCholesky::factorise(const SparseMatrix& lower, const char* what) {
    if (!analysed_) factor_.analyzePattern(lower);
    analysed_ = true;
    factor_.factorize(lower);
    ready_ = factor_.info() == Eigen::Success;
    if (!ready_) throw SolverError(std::string("the factorisation of ") + what + " failed: the matrix is not positive definite");
}

}  // namespace fairing
