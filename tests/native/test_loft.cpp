#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/flips.h"
#include "pipes.h"
#include "problem/surface_state.h"
#include "stand_in/stand_in.h"
#include "start/loft.h"

using namespace fairing;
using test::around;
using test::Pipe;
using test::pipe;

namespace {

std::optional<Fill> loft(const Problem& problem, double roundness) {
    const auto way = Loft::of(problem, roundness, Progress());
    if (!way) return std::nullopt;
    return way->over(problem);
}

double least_radius(const Points& free) { return free.topRows(2).colwise().norm().minCoeff(); }

}  // namespace

TEST_CASE("the lines and the bulge of a loft over a pipe have the radii of closed forms") {
    const Pipe pipe(40);
    for (const double roundness : {0.6, 1.5}) {
        const double a = 0.5 * roundness;
        const auto fill = loft(pipe.problem, roundness);
        REQUIRE(fill);
        CHECK(least_radius(fill->flat) == doctest::Approx(1.0 / std::cosh(a)).epsilon(2e-3));
        const double clamped =
            (std::sinh(a) + a * std::cosh(a)) / (std::sinh(a) * std::cosh(a) + a);  // of r'''' − 2 k² r'' + k⁴ r = 0
        CHECK(least_radius(fill->flat + fill->bulge) == doctest::Approx(clamped).epsilon(2e-3));
    }
}

TEST_CASE("a loft whose slopes make a balloon lets them go") {
    const Pipe pipe(60, -1.3);
    const auto fill = loft(pipe.problem, 0.6);
    REQUIRE(fill);
    const double least = pipe.area(pipe.with(fill->flat));
    REQUIRE(pipe.area(pipe.with(fill->flat + fill->bulge)) > 2.0 * least);
    const auto solution = lofted(pipe.problem, Progress());
    REQUIRE(solution);
    CHECK(is_loft(solution->provenance));
    CHECK(pipe.area(solution->points) <= 2.0 * least);
    CHECK(pipe.area(solution->points) > 1.1 * least);
}

TEST_CASE("one boundary loop, and vertices held elsewhere, have no loft") {
    const test::Single disc = test::single_patch(test::grid(8, 0.2, test::flat));
    const Points fixed = disc.points.rightCols(disc.points.cols() - disc.patch().free_count);
    const Points up = Vector3::UnitZ().replicate(1, fixed.cols());
    CHECK_FALSE(loft({disc.patch(), fixed, up, uniform_weights(disc.patch()), {}}, 0.6));

    const test::Mesh mesh = pipe(10);
    std::vector<char> given(static_cast<std::size_t>(mesh.points.cols()), 0);
    given[5 * around] = 1;
    const test::Single held = test::single_patch(mesh, given);
    const Points boundary = held.points.rightCols(held.points.cols() - held.patch().free_count);
    CHECK_FALSE(loft({held.patch(), boundary, boundary, uniform_weights(held.patch()), {}}, 0.6));
}

TEST_CASE("the least bent of the lofts is taken") {
    for (const double lean : {0.1, 0.5}) {
        const Pipe tube(pipe(20), lean);
        const auto solution = lofted(tube.problem, Progress());
        REQUIRE(solution);
        const double energy = willmore_energy(tube.problem, solution->points);
        for (const double roundness : {0.6, 1.5}) {
            const auto fill = loft(tube.problem, roundness);
            REQUIRE(fill);
            for (const double share : {1.0, 0.5, 0.0})
                CHECK(energy <= willmore_energy(tube.problem, tube.with(fill->flat + share * fill->bulge)) + 1e-12);
        }
    }
}

TEST_CASE("few folds of a loft are turned back") {
    const double edge = 2.0 * std::numbers::pi / around;
    for (const unsigned seed : {2U, 3U, 4U, 5U, 6U, 7U, 10U}) {
        Pipe tube(6, 0.3);
        std::mt19937 random(seed);
        const auto noise = [&] { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0; };
        for (double& coordinate : tube.problem.fixed_points.leftCols(around / 2).reshaped())
            coordinate += 0.9 * edge * noise();
        const auto solution = lofted(tube.problem, Progress());
        CHECK_MESSAGE(solution, seed);
        if (!solution) continue;
        CHECK(flipped_by_solution(tube.single.patch(), solution->points).empty());
    }
}
