// Triangular solves of one right-hand side, or of four side by side, with a front's panel of a Cholesky factor.
#pragma once

#include <deque>

#include <Eigen/Core>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include "linear/elimination.h"

namespace fairing {

// Rows × columns, the front's own rows on top: [L₁₁; L₂₁], column-major. `Stored`: double, or float for an approximate
// factor: all is in single precision then.
template <typename Stored>
using PanelOf = Eigen::Map<const Eigen::Matrix<Stored, Eigen::Dynamic, Eigen::Dynamic>>;

// b = (b₁, b₂) ← (L₁₁⁻¹ b₁, b₂ − L₂₁ L₁₁⁻¹ b₁) for `count` right-hand sides: b has their numbers in each row, one after
// the other.
template <int count, typename Stored>
void eliminate(const PanelOf<Stored>& panel, Stored* b);

// b₁ ← L₁₁⁻ᵀ (b₁ − L₂₁ᵀ b₂).
template <int count, typename Stored>
void substitute(const PanelOf<Stored>& panel, Stored* b);

inline constexpr int lanes = 4;  // right-hand sides side by side

// Dense Cholesky elimination of the leading columns of a symmetric matrix.
template <typename Scalar>
using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <typename Scalar>
using Front = Eigen::Map<Dense<Scalar>>;
// Operations of the dense kernels, roughly.
using WorkDone = std::function<void(double operations)>;

// `front`: rows × columns, the lower trapezoid of a symmetric matrix of order `rows` whose other columns stand in
// `update` (order rows − columns). Replaces the leading block by its factor L₁₁ and what is below it by L₂₁, and takes
// L₂₁ L₂₁ᵀ from the lower triangle of `update`. Only lower triangles are read. False where a pivot is not positive.
// `work_done` is called after each piece of work. In either precision.
template <typename Scalar>
bool eliminate_front(Front<Scalar> front, Dense<Scalar>& update, const WorkDone& work_done);

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
