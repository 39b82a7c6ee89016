// A function of the square root of a sparse matrix, without its spectrum.
#pragma once

#include <vector>

#include "linear/sparse_cholesky.h"

namespace fairing {

// Applies f(A) for a symmetric positive definite A, f(λ) = √λ / (1 + √λ) = 1/π ∫ λ / (λ + s) · ds / (√s (1 + s)) over
// s from 0 to ∞. The trapezoidal rule in log s makes it a sum of shifted inverses, exact to some per cent.
class HalfOrder {
public:
    // `lower`: the lower triangle of A, diagonal included. `least`: about A's least eigenvalue. False where A is not
    // positive definite; apply may not be called then.
    [[nodiscard]] bool update(const SparseMatrix& lower, double least);

    [[nodiscard]] VectorX apply(const VectorX& values) const;

private:
    struct Term {
        double weight;
        double shift;           // s
        SparseCholesky factor;  // of A + s
    };
    std::vector<Term> terms_;
};

}  // namespace fairing
