#include <doctest/doctest.h>

#include <limits>

#include <Eigen/Cholesky>

#include "continuity/joined.h"
#include "continuity/known_curvature.h"
#include "meshes.h"

using namespace fairing;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("where the curvature of a boundary is known") {
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
