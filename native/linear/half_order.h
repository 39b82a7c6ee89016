// A function of the square root of a sparse matrix, without its spectrum.
#pragma once

#include <deque>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include "linear/elimination.h"

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
    // The graph is a set of loops: factors have some three entries in a row, which fronts would only slow down.
    using Factor = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>>;
    struct Term {
        double weight = 0.0;
        double shift = 0.0;  // s
        Factor factor;       // of A + s, in the order
    };
    using Order = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

    Order order_;
    double constant_ = 0.0;   // the part of the integral below the least shift
    std::deque<Term> terms_;  // factors can't be moved
};

}  // namespace fairing
