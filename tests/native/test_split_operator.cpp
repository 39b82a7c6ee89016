#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "linear/conjugate_gradients.h"
#include "linear/half_order.h"
#include "meshes.h"
#include "operators/biharmonic_operator.h"
#include "operators/split_operator.h"

using namespace fairing;
using test::stiffness_of;

namespace {

// From one corner of the square to the other, edges grow by a factor of 20.
Vector3 graded_sphere(double u, double v) {
    const auto stretched = [](double t) { return std::expm1(3.0 * t) / std::expm1(3.0); };
    return test::sphere(stretched(u), stretched(v));
}

struct Case {
    std::string name;
    test::Single single;
    int most_cycles;  // on the outline: measured, and two more
};

std::vector<Case> cases(int n) {
    std::vector<char> inside(static_cast<std::size_t>((n + 1) * (n + 1)), 0);
    for (int k = 0; k <= n / 4; ++k) inside[static_cast<std::size_t>(n / 2 * (n + 1) + n / 3 + k)] = 1;  // a curve
    inside[static_cast<std::size_t>(n / 4 * (n + 1) + n / 4)] = 1;                                       // and a pin
    return {{"sphere", test::single_patch(test::grid(n, 0.3, test::sphere)), 9},
            {"graded", test::single_patch(test::grid(n, 0.2, graded_sphere)), 18},
            {"curve and pin", test::single_patch(test::grid(n, 0.3, test::sphere), inside), 12}};
}

Points fixed_points(const test::Single& single) {
    return single.points.rightCols(single.patch().vertex_count() - single.patch().free_count);
}

Points layout_of(const test::Single& single) { return single.points.leftCols(single.patch().free_count); }

}  // namespace

TEST_CASE("solves in part are those of the whole, where they are wanted") {
    const test::Single single = test::single_patch(test::grid(90, 0.3, test::sphere));
    const Patch& patch = single.patch();
    LaplaceOperator op(patch, layout_of(single));
    REQUIRE(op.update(stiffness_of(single), Progress()));
    const SparseCholesky& factor = op.factor();
    const Indices some{3, 77, patch.free_count - 1};
    VectorX rhs = VectorX::Zero(patch.free_count);
    for (const int k : some) rhs[k] = 1.0 + k;
    const Eigen::MatrixXd twice = op.solve(rhs.replicate(1, 2));  // two columns at once go another way
    const FrontReach reach = factor.reach(some);
    const VectorX whole = factor.solve_vector(rhs);
    CHECK((whole - twice.col(1)).norm() < 1e-13 * whole.norm());
    CHECK((factor.solve_vector(rhs, reach) - whole).norm() < 1e-14 * whole.norm());
    const VectorX part = factor.solve_vector(rhs, FrontReach(), reach);
    for (const int k : some) CHECK(part[k] == whole[k]);
    int reached = 0;
    for (int s = 0; s < factor.tree().nodes().size(); ++s) reached += reach.has(s) ? 1 : 0;
    CHECK(reached < factor.tree().nodes().size() / 3);
}

TEST_CASE("√A (1 + √A)⁻¹ by shifted inverses") {
    // Frequencies from the slowest wave around 400 vertices to the fastest; the sum is within a fortieth of the
    // function.
    const int count = 400;
    std::vector<Eigen::Triplet<double>> entries;
    const double least = 1e-4;
    for (int k = 0; k < count; ++k) {
        entries.emplace_back(k, k, 2.0 + least);
        entries.emplace_back(std::max(k, (k + 1) % count), std::min(k, (k + 1) % count), -1.0);
    }
    SparseMatrix lower(count, count);
    lower.setFromTriplets(entries.begin(), entries.end());
    HalfOrder half_order;
    REQUIRE(half_order.update(lower, least));
    for (const int waves : {0, 1, 5, 30, 120, 200}) {
        const double angle = 2.0 * 3.141592653589793 * waves / count;
        VectorX wave(count);
        for (int k = 0; k < count; ++k) wave[k] = std::cos(angle * k);
        const double root = std::sqrt(2.0 - 2.0 * std::cos(angle) + least);
        CAPTURE(waves);
        CHECK((half_order.apply(wave) - root / (1.0 + root) * wave).norm() < 0.025 * root / (1.0 + root) * wave.norm());
    }
}

TEST_CASE("split by free and fixed vertices, the biharmonic operator has the same inverse") {
    for (const Case& item : cases(24)) {
        CAPTURE(item.name);
        const Patch& patch = item.single.patch();
        const Stiffness stiffness = stiffness_of(item.single);
        BiharmonicOperator assembled(patch);
        SplitBiharmonicOperator split(patch, fixed_points(item.single), layout_of(item.single));
        REQUIRE(assembled.update(stiffness, Progress()));
        Eigen::MatrixXd rhs(patch.free_count, 2);  // smooth and rough
        for (int k = 0; k < patch.free_count; ++k) {
            rhs(k, 0) = stiffness.mass[k];
            rhs(k, 1) = k % 2 == 0 ? 1.0 : -1.0;
        }
        const Eigen::MatrixXd wanted = assembled.solve(rhs);
        for (int k = 0; k < 2; ++k) {  // each by itself, as near as it comes without being asked
            REQUIRE(split.update(stiffness, Progress()));
            CHECK((split.solve(rhs.col(k)) - wanted.col(k)).norm() < 0.01 * wanted.col(k).norm());
        }
        // What it found out about another surface says nothing about this one.
        Stiffness other = stiffness;
        other.mass *= 3.0;
        REQUIRE(split.update(other, Progress()));
        (void)split.solve(rhs, {1e-6});
        // The second column begins with what the first one found; float factors and fast ends leave some digits.
        for (const auto& [accuracy, most] : {std::pair{1e-3, 1e-2}, std::pair{1e-6, 3e-4}}) {
            REQUIRE(split.update(stiffness, Progress()));
            const Eigen::MatrixXd found = split.solve(rhs, {accuracy});
            CAPTURE(accuracy);
            for (int k = 0; k < 2; ++k) CHECK((found - wanted).col(k).norm() < most * wanted.col(k).norm());
        }
    }
}
