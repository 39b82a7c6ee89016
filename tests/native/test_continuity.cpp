#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>

#include "continuity/join_operator.h"
#include "continuity/known_curvature.h"
#include "meshes.h"

using namespace fairing;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Points fixed_points(const test::Single& single) {
    return single.points.rightCols(single.patch().vertex_count() - single.patch().free_count);
}

VectorX waves(Eigen::Index count, double frequency) {
    return (frequency * VectorX::LinSpaced(count, 0.0, 1.0).array()).sin();
}

}  // namespace

TEST_CASE("a step of the join solves the dense equations") {
    const test::Single single = test::single_patch(test::grid(24, 0.2, test::sphere));
    const Patch& patch = single.patch();
    const int free = patch.free_count;
    const Points outline = fixed_points(single);
    const Eigen::Index fixed = outline.cols();
    const KnownCurvature known = known_curvature(patch, single.points, VectorX::Zero(fixed));
    const OutlineModes modes(known.curves, outline);
    JoinOperator join(patch, outline, modes, single.points.leftCols(free));
    const Stiffness stiffness = test::stiffness_of(single);
    REQUIRE(join.update(stiffness, Progress()));

    const Eigen::MatrixXd S = test::dense(patch, stiffness);
    const VectorX residual = stiffness.mass.head(free).cwiseProduct(waves(free, 3.0));
    const VectorX missing = waves(fixed, 2.0);
    const JoinOperator::Step step = join.solve(residual, missing);
    // H changes by J u at all vertices, and S H at the free ones has to become M κ.
    const VectorX change = -(S.leftCols(free) * step.heights).cwiseQuotient(4.0 * stiffness.mass);
    const VectorX kappa = join.harmonic(step.coefficients);
    const VectorX left = residual + S.topRows(free) * change - stiffness.mass.head(free).cwiseProduct(kappa);
    CHECK(left.norm() < 0.02 * (S.topRightCorner(free, fixed) * change.tail(fixed)).norm());
    const VectorX wanted = modes.projected(missing);
    CHECK((modes.projected(change.tail(fixed)) - wanted).norm() < 0.02 * wanted.norm());
    // κ is harmonic, with the multipliers on the outline.
    VectorX all(free + fixed);
    all << kappa, modes.multipliers(step.coefficients);
    CHECK((S.topRows(free) * all).norm() < 1e-9 * all.norm());
}

TEST_CASE("waves along an outline are nearly orthonormal, whatever its spacing") {
    for (const double stretch : {1.0, 8.0}) {
        constexpr int count = 96;
        OutlineCurve curve{{}, true};
        Points points(3, count);
        for (int k = 0; k < count; ++k) {
            curve.places.push_back(k);
            const double t = 2.0 * std::numbers::pi * k / count;
            const double angle = t + (1.0 - 1.0 / stretch) * std::sin(t);  // `stretch` times as dense at π
            points.col(k) << std::cos(angle), std::sin(angle), 0.0;
        }
        const OutlineModes modes({curve}, points);
        CHECK(modes.count() == 1 + 2 * (count / 6));
        for (Eigen::Index m = 0; m < modes.count(); ++m) {
            const VectorX wave = modes.combined(VectorX::Unit(modes.count(), m));
            CHECK((modes.projected(wave) - VectorX::Unit(modes.count(), m)).norm() < 0.1);
        }
    }
}

TEST_CASE("where the curvature of an outline is known") {
    const test::Single single = test::single_patch(test::grid(12, 0.0, test::flat));
    const Patch& patch = single.patch();
    Indices loop = patch.loops().front();
    for (int& v : loop) v -= patch.free_count;
    VectorX curvatures = VectorX::Constant(static_cast<Eigen::Index>(loop.size()), 2.0);

    SUBCASE("everywhere: a loop") {
        const KnownCurvature known = known_curvature(patch, single.points, curvatures);
        REQUIRE(known.curves.size() == 1);
        CHECK(known.curves[0].closed);
        CHECK(known.unknown.empty());
    }
    SUBCASE("short gaps are bridged by what is between their ends") {
        curvatures[loop[20]] = 6.0;
        for (const int k : {21, 22, 23}) curvatures[loop[std::size_t(k)]] = unknown;
        const KnownCurvature known = known_curvature(patch, single.points, curvatures);
        REQUIRE(known.curves.size() == 1);
        CHECK(known.values[loop[22]] == doctest::Approx(4.0));
        CHECK(known.unknown.empty());
    }
    SUBCASE("a wide gap leaves an arc, across the loop's first vertex, too") {
        for (int k = 10; k < 20; ++k) curvatures[loop[std::size_t(k)]] = unknown;
        const KnownCurvature known = known_curvature(patch, single.points, curvatures);
        REQUIRE(known.curves.size() == 1);
        CHECK_FALSE(known.curves[0].closed);
        CHECK(known.curves[0].places.size() == loop.size() - 10);
        CHECK(known.curves[0].places.front() == loop[20]);
        CHECK(known.unknown.size() == 10);
    }
    SUBCASE("what lacks at corners is interpolated") {
        const KnownCurvature known = known_curvature(patch, single.points, curvatures);
        VectorX present = VectorX::Constant(curvatures.size(), 1.5);
        int corners = 0;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            if (!known.curves[0].skipped[k]) continue;
            present[known.curves[0].places[k]] = -7.0;
            ++corners;
        }
        CHECK(corners == 4);
        const VectorX missing = known.missing(present);
        for (const int place : loop) CHECK(missing[place] == doctest::Approx(0.5));
    }
    SUBCASE("nowhere, or in too few vertices") {
        curvatures.setConstant(unknown);
        for (int k = 5; k < 10; ++k) curvatures[loop[std::size_t(k)]] = 1.0;
        const KnownCurvature known = known_curvature(patch, single.points, curvatures);
        CHECK(known.curves.empty());
        CHECK(known.unknown.size() == loop.size());
    }
}
