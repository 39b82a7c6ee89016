#include "linear/gmres.h"

#include <Eigen/Jacobi>
#include <Eigen/LU>

#include "base/limits.h"

namespace fairing {

namespace {

// The least squares problem of the Hessenberg matrix, kept triangular by Givens rotations.
class Hessenberg {
public:
    Hessenberg(int most_steps, double first) : r_(Eigen::MatrixXd::Zero(most_steps + 1, most_steps)) {
        g_ = VectorX::Zero(most_steps + 1);
        g_[0] = first;
    }

    // Takes the next column (its first `rotations + 2` entries) and gives the norm of the residual that is left.
    double add(const VectorX& column) {
        const auto k = static_cast<Eigen::Index>(rotations_.size());
        r_.col(k).head(k + 2) = column.head(k + 2);
        for (Eigen::Index i = 0; i < k; ++i) {
            r_.col(k).applyOnTheLeft(i, i + 1, rotations_[static_cast<std::size_t>(i)].adjoint());
        }
        Eigen::JacobiRotation<double>& rotation = rotations_.emplace_back();
        rotation.makeGivens(r_(k, k), r_(k + 1, k));
        r_.col(k).applyOnTheLeft(k, k + 1, rotation.adjoint());
        g_.applyOnTheLeft(k, k + 1, rotation.adjoint());
        return std::abs(g_[k + 1]);
    }

    [[nodiscard]] VectorX solve() const {
        const auto k = static_cast<Eigen::Index>(rotations_.size());
        return r_.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(g_.head(k));
    }

private:
    Eigen::MatrixXd r_;
    VectorX g_;
    std::vector<Eigen::JacobiRotation<double>> rotations_;
};

}  // namespace

VectorX gmres(const LinearMap& apply, const LinearMap& precondition, const VectorX& b, double relative_tolerance,
              int most_steps) {
    const double size = b.norm();
    if (!(size > 0.0)) return VectorX::Zero(b.size());
    Eigen::MatrixXd basis(b.size(), most_steps + 1);
    basis.col(0) = b / size;
    Hessenberg projected(most_steps, size);
    int steps = 0;
    for (double left = size; steps < most_steps && left > relative_tolerance * size;) {
        VectorX w = apply(precondition(basis.col(steps)));
        const double whole = w.norm();
        VectorX column = VectorX::Zero(most_steps + 1);
        // Twice is enough for orthogonality to round-off.
        for (int pass = 0; pass < 2; ++pass) {
            const VectorX h = basis.leftCols(steps + 1).transpose() * w;
            column.head(steps + 1) += h;
            w -= basis.leftCols(steps + 1) * h;
        }
        column[steps + 1] = w.norm();
        const bool exhausted = !(column[steps + 1] > roundoff * whole);  // A takes the directions to themselves
        left = projected.add(column);
        ++steps;
        if (exhausted) break;
        basis.col(steps) = w / column[steps];
    }
    return precondition(basis.leftCols(steps) * projected.solve());
}

}  // namespace fairing
