// Least squares in a few unknowns by their normal equations.
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace fairing {

// Sums weighted rows a · x = value of N unknowns. The sums are written out for N known to the compiler: rings have few
// rows, and every step of the iteration fits two of them at every vertex.
template <int N, typename Scalar = double>
class NormalEquations {
public:
    using Vector = Eigen::Matrix<Scalar, N, 1>;

    void add(const Vector& row, Scalar value, Scalar weight) {
        for (int j = 0; j < N; ++j) {
            const Scalar weighted = weight * row[j];
            rhs_[j] += weighted * value;
            for (int i = j; i < N; ++i) matrix_(i, j) += weighted * row[i];
        }
    }

    [[nodiscard]] Scalar trace() const { return matrix_.trace(); }
    void add_to_diagonal(Scalar value) { matrix_.diagonal().array() += value; }
    void add_to_diagonal(int k, Scalar value) { matrix_(k, k) += value; }

    // By Cholesky's factor; the matrix must be positive definite. Destroys the sums.
    [[nodiscard]] Vector solve() {
        using std::sqrt;
        Vector inverse;  // of the factor's diagonal
        for (int j = 0; j < N; ++j) {
            const Scalar pivot = inverse[j] = 1.0 / sqrt(matrix_(j, j));
            for (int i = j + 1; i < N; ++i) matrix_(i, j) *= pivot;
            for (int k = j + 1; k < N; ++k) {
                for (int i = k; i < N; ++i) matrix_(i, k) -= matrix_(i, j) * matrix_(k, j);
            }
            rhs_[j] *= pivot;
            for (int i = j + 1; i < N; ++i) rhs_[i] -= matrix_(i, j) * rhs_[j];
        }
        for (int j = N - 1; j >= 0; --j) {
            for (int i = j + 1; i < N; ++i) rhs_[j] -= matrix_(i, j) * rhs_[i];
            rhs_[j] *= inverse[j];
        }
        return rhs_;
    }

private:
    Eigen::Matrix<Scalar, N, N> matrix_ = Eigen::Matrix<Scalar, N, N>::Zero();  // its lower triangle
    Vector rhs_ = Vector::Zero();
};

}  // namespace fairing
