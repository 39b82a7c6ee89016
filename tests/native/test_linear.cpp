#include <doctest/doctest.h>

#include <random>

#include "base/errors.h"
#include "linear/anderson.h"
#include "linear/gmres.h"
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

TEST_CASE("an indefinite matrix is refused") {
    SparseMatrix lower = random_matrix(50, 1, 7);
    lower.coeffRef(20, 20) = -1.0;
    SparseCholesky factor;
    CHECK_FALSE(factor.factorise(lower, "the operator", Progress()));
}

TEST_CASE("a factorisation can be cancelled and done again") {
    SparseCholesky factor;
    const SparseMatrix lower = random_matrix(200, 1, 3);
    CHECK_THROWS_AS(
        static_cast<void>(factor.factorise(lower, "x", Progress([](double, std::string_view) { return false; }))),
        Cancelled);
    REQUIRE(factor.factorise(lower, "x", Progress()));
    const VectorX rhs = VectorX::Ones(200);
    CHECK((lower.selfadjointView<Eigen::Lower>() * factor.solve(rhs) - rhs).norm() < 1e-10);
}

TEST_CASE("Anderson acceleration ends a linear iteration within its dimension") {
    // x ← x + (b − A x) with eigenvalues of A in (0, 2): slow by itself, exact after dimension + 1 accelerated steps.
    const VectorX diagonal = VectorX::LinSpaced(5, 0.01, 1.99);
    const VectorX b = VectorX::Ones(5);
    VectorX x = VectorX::Zero(5);
    Anderson anderson(5, 6);
    for (int k = 0; k < 7; ++k) x += anderson.step(x, b - diagonal.cwiseProduct(x));
    CHECK((diagonal.cwiseProduct(x) - b).norm() < 1e-8);
}

TEST_CASE("GMRES solves systems that are not symmetric, at the latest after as many steps as unknowns") {
    std::srand(5);
    const int n = 30;
    const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n, n) + 3.0 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd M = Eigen::MatrixXd::Random(n, n) + 4.0 * Eigen::MatrixXd::Identity(n, n);
    const VectorX b = VectorX::Random(n);
    const LinearMap apply = [&](const VectorX& x) { return VectorX(A * x); };
    const LinearMap precondition = [&](const VectorX& x) { return VectorX(M * x); };
    const VectorX x = gmres(apply, precondition, b, 1e-12, n);
    CHECK((A * x - b).norm() < 1e-10 * b.norm());
    double last = b.norm();
    for (int steps = 1; steps < n; steps += 4) {
        const double left = (A * gmres(apply, precondition, b, 0.0, steps) - b).norm();
        CHECK(left < last * (1.0 + 1e-12));
        last = left;
    }
    CHECK(gmres(apply, precondition, VectorX::Zero(n), 1e-12, n).norm() == 0.0);
}
