#include <doctest/doctest.h>

#include <cmath>

#include "fill/quads.h"

using namespace fairing;

namespace {

// A kite-like pair over the diagonal from (0, −1) to (0, 1), its second tip at (x, 0).
PairedQuads pair_of(double x, double height = 0.0) {
    Points points(3, 4);
    points.transpose() << -1, 0, 0, 0, -1, 0, x, 0, height, 0, 1, 0;
    Triangles triangles(3, 2);
    triangles.transpose() << 0, 1, 3, 3, 1, 2;
    return paired_quads(points, triangles, {});
}

// A strip of n triangles, the rungs of which stand on whole numbers.
Triangles strip(int n) {
    Triangles triangles(3, n);
    for (int t = 0; t < n; ++t)
        if (t % 2 == 0)
            triangles.col(t) << t, t + 2, t + 1;
        else
            triangles.col(t) << t, t + 1, t + 2;
    return triangles;
}

Points strip_points(int n) {
    Points points(3, n + 2);
    for (int v = 0; v < n + 2; ++v) points.col(v) << 0.5 * v, v % 2 == 0 ? 0.0 : 0.9, 0.0;
    return points;
}

}  // namespace

TEST_CASE("quads: two halves of a square become it, wound alike") {
    const PairedQuads paired = pair_of(1.0);
    REQUIRE(paired.quads.cols() == 1);
    CHECK(paired.quads.col(0) == Eigen::Vector4i(0, 1, 2, 3));
    CHECK(paired.rest.empty());
}

TEST_CASE("quads: what is not convex, or bent, stays two triangles") {
    CHECK(pair_of(0.2).rest.empty());
    CHECK(pair_of(0.05).rest == Indices{0, 1});
    Points points(3, 4);  // an arrowhead: the diagonal ends in a reflex corner
    points.transpose() << -1, 0, 0, 0, 0, 0, -0.5, 2, 0, 1, 0.5, 0;
    Triangles triangles(3, 2);
    triangles.transpose() << 0, 1, 2, 2, 1, 3;
    CHECK(paired_quads(points, triangles, {}).rest.empty());
    points.col(1) << 0.3, 0.8, 0;
    CHECK(paired_quads(points, triangles, {}).rest == Indices{0, 1});
    CHECK(pair_of(std::cos(0.6), std::sin(0.6)).rest.empty());
    CHECK(pair_of(std::cos(0.8), std::sin(0.8)).rest == Indices{0, 1});
}

TEST_CASE("quads: paths pair what the best pairs leave over") {
    Points points(3, 6);  // a square of the middle two, which are the best pair, and a roof on either side
    points.transpose() << -1, 0.5, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1, 0, 0, 2, 0.5, 0;
    const Triangles triangles = strip(4);
    const PairedQuads paired = paired_quads(points, triangles, {});
    CHECK(paired.rest.empty());
    CHECK(paired.pairs == std::vector<std::array<int, 2>>{{0, 1}, {2, 3}});
}

TEST_CASE("quads: kept edges, given in either order, are no diagonals") {
    for (const std::array<int, 2> ends : {std::array<int, 2>{1, 2}, std::array<int, 2>{2, 1}}) {
        const PairedQuads paired = paired_quads(strip_points(2), strip(2), {ends});
        CHECK(paired.quads.cols() == 0);
        CHECK(paired.rest == Indices{0, 1});
    }
}
