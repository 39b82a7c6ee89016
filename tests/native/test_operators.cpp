#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include "meshes.h"
#include "operators/biharmonic_operator.h"
#include "operators/laplace_operator.h"

using namespace fairing;
using test::dense;
using test::stiffness_of;

TEST_CASE("S has constants and, on a plane, linear functions in its kernel; masses add up to the area") {
    const test::Single single = test::single_patch(test::grid(7, 0.3, test::flat));
    const Stiffness stiffness = stiffness_of(single);
    const Points Sx = stiffness.apply(single.patch(), single.points, single.patch().free_count);
    CHECK(Sx.cwiseAbs().maxCoeff() < 1e-13);
    CHECK(stiffness.mass.sum() == doctest::Approx(1.0));
}

TEST_CASE("S is symmetric and positive semidefinite") {
    const test::Single single = test::single_patch(test::grid(5, 0.3, test::sphere));
    const Eigen::MatrixXd S = dense(single.patch(), stiffness_of(single));
    CHECK((S - S.transpose()).norm() < 1e-13);
    const VectorX eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(S).eigenvalues();
    CHECK(eigenvalues[0] == doctest::Approx(0.0).epsilon(1e-12));
    CHECK(eigenvalues[1] > 1e-3);
}

TEST_CASE("the biharmonic operator inverts S_I (4M)⁻¹ S_Iᵀ") {
    const test::Single single = test::single_patch(test::grid(6, 0.3, test::sphere));
    const Patch& patch = single.patch();
    const Stiffness stiffness = stiffness_of(single);
    const Eigen::MatrixXd SI = dense(patch, stiffness).topRows(patch.free_count);
    const Eigen::MatrixXd K = SI * (4.0 * stiffness.mass).cwiseInverse().asDiagonal() * SI.transpose();
    BiharmonicOperator op(patch);
    REQUIRE(op.update(stiffness, Progress()));
    const VectorX rhs = VectorX::LinSpaced(patch.free_count, -1.0, 1.0);
    CHECK((K * op.solve(rhs) - rhs).norm() < 1e-10 * rhs.norm());
}

TEST_CASE("the Laplace operator inverts S_II") {
    const test::Single single = test::single_patch(test::grid(6, 0.3, test::sphere));
    const Patch& patch = single.patch();
    const Stiffness stiffness = stiffness_of(single);
    const Eigen::MatrixXd SII = dense(patch, stiffness).topLeftCorner(patch.free_count, patch.free_count);
    LaplaceOperator op(patch);
    REQUIRE(op.update(stiffness, Progress()));
    const VectorX rhs = VectorX::LinSpaced(patch.free_count, -1.0, 1.0);
    CHECK((SII * op.solve(rhs) - rhs).norm() < 1e-12 * rhs.norm());
}
