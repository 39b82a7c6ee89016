#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "geometry/flips.h"
#include "geometry/outline_angles.h"
#include "geometry/spikes.h"
#include "method/lofted.h"
#include "pipes.h"
#include "problem/surface_state.h"
#include "start/loft.h"

using namespace fairing;
using test::around;
using test::Pipe;
using test::pipe;

namespace {

// A finger of six vertices around instead of the triangles at one vertex: it ends inside.
test::Mesh with_finger(const test::Mesh& mesh, int vertex, int length) {
    Indices ring;  // followed counterclockwise
    std::vector<Eigen::Vector3i> kept;
    std::map<int, int> next;
    for (const auto t : mesh.triangles.colwise()) {
        const Eigen::Vector3i corners = t;
        const auto found = std::find(corners.begin(), corners.end(), vertex);
        if (found == corners.end()) {
            kept.push_back(corners);
            continue;
        }
        const auto k = found - corners.begin();
        next[corners[(k + 1) % 3]] = corners[(k + 2) % 3];
    }
    for (int v = next.begin()->first; ring.size() < next.size(); v = next[v]) ring.push_back(v);
    const int around_it = static_cast<int>(ring.size());
    int count = static_cast<int>(mesh.points.cols());
    for (int r = 0; r < length; ++r) {
        Indices upper;
        for (int c = 0; c < around_it; ++c) upper.push_back(count++);
        for (int c = 0; c < around_it; ++c) {
            const auto here = static_cast<std::size_t>(c);
            const auto there = static_cast<std::size_t>((c + 1) % around_it);
            kept.emplace_back(ring[here], ring[there], upper[here]);
            kept.emplace_back(ring[there], upper[there], upper[here]);
        }
        ring = upper;
    }
    for (std::size_t c = 0; c < ring.size(); ++c) kept.emplace_back(ring[c], ring[(c + 1) % ring.size()], vertex);
    test::Mesh result{Points::Zero(3, count), Triangles(3, static_cast<Eigen::Index>(kept.size()))};
    result.points.leftCols(mesh.points.cols()) = mesh.points;
    for (std::size_t t = 0; t < kept.size(); ++t) result.triangles.col(static_cast<Eigen::Index>(t)) = kept[t];
    return result;
}

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

TEST_CASE("slopes are let go where the normals turn along the outline") {
    Pipe pipe(20, 0.5);
    const Points before = loft(pipe.problem, 0.6)->bulge;
    for (Eigen::Index k = 0; k < pipe.problem.fixed_normals.cols(); k += 2) {
        const Vector3 radial = pipe.problem.fixed_points.col(k).cwiseProduct(Vector3(1.0, 1.0, 0.0));
        pipe.problem.fixed_normals.col(k) = -pipe.problem.fixed_normals.col(k) + 0.2 * radial;
        pipe.problem.fixed_normals.col(k).normalize();
    }
    const Points after = loft(pipe.problem, 0.6)->bulge;
    CHECK(before.cwiseAbs().maxCoeff() > 0.05);
    CHECK(after.cwiseAbs().maxCoeff() < 1e-12);
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

TEST_CASE("one outline, and vertices held elsewhere, have no loft") {
    const test::Single disc = test::single_patch(test::grid(8, 0.2, test::flat));
    const Points fixed = disc.points.rightCols(disc.points.cols() - disc.patch().free_count);
    const Points up = Vector3::UnitZ().replicate(1, fixed.cols());
    CHECK_FALSE(loft({disc.patch(), fixed, up, uniform_weights(disc.patch()), {}}, 0.6));

    const test::Mesh mesh = pipe(10);
    std::vector<char> given(static_cast<std::size_t>(mesh.points.cols()), 0);
    given[5 * around] = 1;
    const test::Single held = test::single_patch(mesh, given);
    const Points outline = held.points.rightCols(held.points.cols() - held.patch().free_count);
    CHECK_FALSE(loft({held.patch(), outline, outline, uniform_weights(held.patch()), {}}, 0.6));
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

TEST_CASE("two outlines joined by an edge have a loft") {
    const test::Mesh mesh = pipe(20);
    std::vector<char> given(static_cast<std::size_t>(mesh.points.cols()), 0);
    for (std::size_t r = 0; r <= 20; ++r) given[r * around] = 1;
    const test::Single cut = test::single_patch(mesh, given);
    REQUIRE(cut.patch().loop_count() == 1);
    const Points fixed = cut.points.rightCols(cut.points.cols() - cut.patch().free_count);
    Points normals = fixed;
    normals.row(2).setZero();
    const auto fill = loft({cut.patch(), fixed, normals, uniform_weights(cut.patch()), {}}, 0.6);
    REQUIRE(fill);
    CHECK(least_radius(fill->flat + fill->bulge) > 0.9);
}

TEST_CASE("a finger that ends inside does not become a hair") {
    const double radius = std::numbers::pi / around;  // half an edge of the outline
    for (const int row : {8, 15}) {
        const Pipe tube(with_finger(pipe(30), row * around + 5, 6), -1.0);
        double least = 1e9;
        bool least_is_spiky = false;
        for (const double roundness : {0.6, 1.5, 4.0}) {
            const auto fill = loft(tube.problem, roundness);
            REQUIRE(fill);
            for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
                const Points points = tube.with(fill->flat + share * fill->bulge);
                const double energy = willmore_energy(tube.problem, points);
                if (energy >= least) continue;
                least = energy;
                least_is_spiky = has_spike(tube.single.patch(), points, radius);
            }
        }
        CHECK(least_is_spiky);
        const auto solution = lofted(tube.problem, Progress());
        REQUIRE(solution);
        CHECK_FALSE(has_spike(tube.single.patch(), solution->points, radius));
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

TEST_CASE("a loft meets little of its outline from behind") {
    constexpr double lean = 3.0;
    Pipe pipe(20);
    for (Eigen::Index k = 0; k < pipe.problem.fixed_points.cols(); ++k) {
        const Vector3 point = pipe.problem.fixed_points.col(k);
        if (point[0] < 0.5) continue;
        const double side = point[2] < 1.0 ? 1.0 : -1.0;
        pipe.problem.fixed_normals.col(k) << std::cos(lean) * point[0], std::cos(lean) * point[1],
            side * std::sin(lean);
    }
    const auto solution = lofted(pipe.problem, Progress());
    REQUIRE(solution);
    const VectorX angles = boundary_angles(pipe.single.patch(), solution->boundary_normals, pipe.problem.fixed_normals);
    CHECK(20 * (angles.array() > 90.0).count() <= angles.size());
}
