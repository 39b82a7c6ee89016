#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "linear/sparse_cholesky.h"

using namespace fairing;

namespace {

// Random sparse diagonally dominant matrix, lower triangle; `blocks` unconnected parts.
SparseMatrix random_matrix(int n, int blocks, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Eigen::Triplet<double>> entries;
    VectorX diagonal = VectorX::Constant(n, 0.1);
    for (int k = 0; k < 4 * n; ++k) {
        const int i = static_cast<int>(random() % static_cast<unsigned>(n));
        const int j = static_cast<int>(random() % static_cast<unsigned>(n));
        if (i == j || i % blocks != j % blocks) continue;
        const double value = static_cast<double>(random() % 1000) / 500.0 - 1.0;
        entries.emplace_back(std::max(i, j), std::min(i, j), value);
        diagonal[i] += std::abs(value);
        diagonal[j] += std::abs(value);
    }
    for (int i = 0; i < n; ++i) entries.emplace_back(i, i, diagonal[i]);
    SparseMatrix matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

}  // namespace

TEST_CASE("the factor solves random systems, connected or not, and keeps its ordering for new values") {
    for (const int n : {1, 2, 17, 300}) {
        for (const int blocks : {1, 3}) {
            SparseMatrix lower = random_matrix(n, blocks, static_cast<unsigned>(n + blocks));
            SparseCholesky factor;
            for (int round = 0; round < 2; ++round) {
                REQUIRE(factor.factorise(lower, "a test matrix", Progress()));
                const Eigen::MatrixXd full = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
                const Eigen::MatrixXd rhs = Eigen::MatrixXd::Random(n, 3);
                CHECK((full * factor.solve(rhs) - rhs).norm() < 1e-11 * rhs.norm());
                for (int j = 0; j < n; ++j) lower.coeffRef(j, j) *= 1.5;
            }
        }
    }
}

TEST_CASE("a factor in single precision is right to single precision, and refuses what the other one does") {
    for (const int blocks : {1, 3}) {
        const SparseMatrix lower = random_matrix(600, blocks, 5);
        SparseCholesky exact;
        SparseCholesky near(Points(3, 0), Kept::singles);
        REQUIRE(exact.factorise(lower, "test", {}));
        REQUIRE(near.factorise(lower, "test", {}));
        const Eigen::MatrixXd rhs = Eigen::MatrixXd::Random(600, 2);
        const Eigen::MatrixXd x = exact.solve(rhs);
        const double off = (near.solve(rhs) - x).norm() / x.norm();
        CHECK(off < 1e-5);
        CHECK(off > 1e-10);  // it is kept in singles
        CHECK((near.solve_vector(rhs.col(0)) - x.col(0)).norm() < 1e-5 * x.col(0).norm());
    }
    SparseMatrix indefinite = random_matrix(600, 1, 5);
    indefinite.coeffRef(7, 7) = -1.0;
    SparseCholesky refusing(Points(3, 0), Kept::singles);
    CHECK_FALSE(refusing.factorise(indefinite, "test", {}));
}

TEST_CASE("an indefinite matrix is refused") {
    SparseMatrix lower = random_matrix(50, 1, 7);
    lower.coeffRef(20, 20) = -1.0;
    SparseCholesky factor;
    CHECK_FALSE(factor.factorise(lower, "the operator", Progress()));
}
