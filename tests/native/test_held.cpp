// Pieces of what holds inside a patch: faired borders, surroundings broken along creases.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "boundary/fair_border.h"
#include "boundary/low_passed_boundary.h"
#include "meshes.h"
#include "problem/free_slopes.h"

using namespace fairing;

namespace {

Points ellipse(int count) {
    Points points(3, count);
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        points.col(k) << 2.0 * std::cos(angle), std::sin(angle), 0.5 * std::cos(angle);
    }
    return points;
}

Indices everything(int count) {
    Indices result;
    for (int k = 0; k < count; ++k) result.push_back(k);
    return result;
}

}  // namespace

TEST_CASE("an ellipse of even spacing is a fair border") {
    const int count = 40;
    const Points exact = ellipse(count);
    Points points = exact;
    fair_border(everything(count), std::vector<char>(count, 1), points);
    CHECK((points - exact).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("triangles broken along an edge have a copy of its ends for each fan") {
    Triangles triangles(3, 4);  // a square around vertex 4
    triangles << 0, 1, 2, 3, 1, 2, 3, 0, 4, 4, 4, 4;
    const BrokenSurface whole = broken_along(triangles, 5, {});
    CHECK(whole.input_vertex.size() == 5);
    const BrokenSurface slit = broken_along(triangles, 5, {{0, 4}});
    CHECK(slit.input_vertex.size() == 6);  // 0 twice
    const BrokenSurface halves = broken_along(triangles, 5, {{4, 0}, {2, 4}});
    CHECK(halves.input_vertex.size() == 8);
    for (Eigen::Index c = 0; c < triangles.size(); ++c)
        CHECK(halves.input_vertex[halves.triangles(c % 3, c / 3)] == triangles(c % 3, c / 3));
}
