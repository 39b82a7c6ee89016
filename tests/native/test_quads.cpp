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

}  // namespace

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
