#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

#include "fairness/harmonic_values.h"
#include "fill/ball_start.h"
#include "fill/edge_lengths.h"
#include "fill/equal_edge_mesh.h"
#include "fill/first_surface.h"
#include "fill/joined_loops.h"
#include "fill/triangulation.h"
#include "fill/tube_start.h"
#include "meshes.h"

using namespace fairing;

namespace {

Indices first_numbers(int n, int begin = 0) {
    Indices numbers(n);
    std::iota(numbers.begin(), numbers.end(), begin);
    return numbers;
}

double total(const std::vector<Eigen::Vector3i>& triangles, const TriangleCost& cost) {
    double sum = 0.0;
    for (const Eigen::Vector3i& t : triangles) sum += cost(t[0], t[1], t[2]);
    return sum;
}

// Of all triangulations, one after the other.
double cheapest_by_trying(const Indices& polygon, const TriangleCost& cost) {
    if (polygon.size() < 3) return 0.0;
    double least = 1e300;
    for (std::size_t j = 1; j + 1 < polygon.size(); ++j) {
        const Indices before(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        const Indices after(polygon.begin() + static_cast<std::ptrdiff_t>(j), polygon.end());
        const double here = cost(polygon.front(), polygon[j], polygon.back()) + cheapest_by_trying(before, cost) +
                            cheapest_by_trying(after, cost);
        least = std::min(least, here);
    }
    return least;
}

Points random_polygon(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-0.4, 0.4);
    Points points(3, n);
    for (int k = 0; k < n; ++k) {
        const double turn = 2.0 * std::numbers::pi * k / n;
        points.col(k) << std::cos(turn) + noise(random), std::sin(turn) + noise(random), noise(random);
    }
    return points;
}

// Each side once, and those without a partner in the other direction.
std::vector<std::pair<int, int>> open_sides(const Triangles& triangles) {
    std::map<std::pair<int, int>, int> sides;
    for (const auto t : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
    }
    std::vector<std::pair<int, int>> open;
    for (const auto& [side, count] : sides) {
        CHECK(count == 1);
        if (!sides.contains({side.second, side.first})) open.push_back(side);
    }
    return open;
}

Points ring(int n, double height, double turn = 0.0) {
    Points points(3, n);
    for (int k = 0; k < n; ++k) {
        const double angle = turn + 2.0 * std::numbers::pi * k / n;
        points.col(k) << std::cos(angle), std::sin(angle), height;
    }
    return points;
}

}  // namespace

TEST_CASE("no triangulation of a small polygon is cheaper than the one found") {
    for (unsigned seed = 0; seed < 8; ++seed) {
        const Points points = random_polygon(9, seed);
        const TriangleCost cost(points);
        const Indices polygon = first_numbers(9);
        const auto triangles = cheapest_triangulation(polygon, cost);
        CHECK(triangles.size() == 7);
        CHECK(total(triangles, cost) == doctest::Approx(cheapest_by_trying(polygon, cost)).epsilon(1e-12));
    }
}

TEST_CASE("two rings become a tube without caps, however far apart") {
    for (const double gap : {0.2, 2.0, 8.0}) {
        Points points(3, 36);
        points << ring(20, 0.0), ring(16, gap, 0.1);
        const Indices below = first_numbers(20);
        Indices above = first_numbers(16, 20);
        std::reverse(above.begin(), above.end());
        const Triangles triangles = joined_loops(points, {below, above});
        CHECK(triangles.cols() == 36);
        CHECK(open_sides(triangles).size() == 36);
        for (const auto t : triangles.colwise()) {
            const bool rises = std::min({t[0], t[1], t[2]}) < 20 && std::max({t[0], t[1], t[2]}) >= 20;
            CHECK(rises);
            const Vector3 across = (points.col(t[1]) - points.col(t[0])).cross(points.col(t[2]) - points.col(t[0]));
            CHECK(across.dot(points.col(t[0]) - Vector3(0.0, 0.0, points(2, t[0]))) > 0.0);  // outwards
        }
    }
}

namespace {

// A flat square of n × n quads, sheared so that a fan of its triangles has angles beyond 120°; the border is fixed.
test::Single stretched_square(int n) {
    const auto sheared = [n](double u, double v) { return Vector3(n * (u + 0.8 * v), 0.3 * n * v, 0.0); };
    return test::single_patch(test::grid(n, 0.0, sheared, false));
}

}  // namespace

TEST_CASE("harmonic values stay within the range of those given, wide angles or not") {
    const test::Single square = stretched_square(8);
    const int fixed_count = square.patch().vertex_count() - square.patch().free_count;
    Eigen::MatrixXd given(fixed_count, 2);
    for (int k = 0; k < fixed_count; ++k) given.row(k) << (k == 3 ? 1.0 : 0.0), (k % 7 == 0 ? -1.0 : 2.0);
    const auto inside = harmonic_values(square.patch(), square.points, given);
    REQUIRE(inside);
    for (int c = 0; c < 2; ++c) {
        CHECK(inside->col(c).minCoeff() >= given.col(c).minCoeff() - 1e-12);
        CHECK(inside->col(c).maxCoeff() <= given.col(c).maxCoeff() + 1e-12);
    }
}

TEST_CASE("a mesh over a crumpled surface does not grow without end") {
    test::Single square = stretched_square(6);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise(-4.0, 4.0);
    const auto any = [&] { return Vector3(noise(random), noise(random), noise(random)); };
    for (int v = 0; v < square.patch().free_count; ++v) square.points.col(v) += any();
    const auto count = square.points.cols();
    Points normals(3, count);
    for (Eigen::Index v = 0; v < count; ++v) normals.col(v) = any().normalized();
    const TargetSurface surface(square.patch(), square.points, normals);
    const VectorX lengths = VectorX::Constant(count, 0.7);
    EqualEdgeMesh mesh(square.patch(), square.points, surface, lengths);
    mesh.equalise();
    const double expected = expected_count(square.patch(), square.points, lengths) + static_cast<double>(count);
    CHECK(static_cast<double>(mesh.result().points.cols()) < 3.0 * expected);  // six times without a limit
}

namespace {

// A flat disc with its rim on a unit ball around the origin, at this angle from the direction of `side` · z.
test::Single disc_on_ball(double half_angle, double side) {
    return test::single_patch(test::grid(
        12, 0.0,
        [&](double u, double v) {
            const double x = 2.0 * u - 1.0;
            const double y = 2.0 * v - 1.0;
            const double turn = std::atan2(y, x);
            const double radius = std::max(std::abs(x), std::abs(y)) * std::sin(half_angle);
            return Vector3(radius * std::cos(turn), radius * std::sin(turn), side * std::cos(half_angle));
        },
        false));
}

}  // namespace

TEST_CASE("a start that bulges out beyond its boundary lies on the ball of the boundary's normals") {
    constexpr double degree = std::numbers::pi / 180.0;
    for (const double side : {1.0, -1.0}) {
        for (const double angle : {120.0, 150.0, 170.0}) {
            const test::Single disc = disc_on_ball(angle * degree, side);
            const Patch& patch = disc.patch();
            const Points normals = side * disc.points.rightCols(patch.vertex_count() - patch.free_count);
            const Vector3 away(3.0, -2.0, 1.0);
            const Points places = (5.0 * disc.points).colwise() + away;
            const auto start = ball_start(patch, places, normals);
            REQUIRE(start.has_value());
            const Points local = (start->colwise() - away) / 5.0;
            CHECK((local.colwise().norm().array() - 1.0).abs().maxCoeff() < 1e-12);
            CHECK((local.rightCols(normals.cols()) - disc.points.rightCols(normals.cols())).norm() < 1e-12);
            CHECK((side * local.row(2)).maxCoeff() > 0.9);  // its far side, seen from the boundary
            FaceGeometry faces;
            faces.update(local, patch.triangles);
            CHECK(faces.areas.sum() > 0.9 * 2.0 * std::numbers::pi * (1.0 - std::cos(angle * degree)));
        }
    }
}
