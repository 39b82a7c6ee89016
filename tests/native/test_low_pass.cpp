#include <doctest/doctest.h>

#include "detail/low_pass.h"

using namespace fairing;

TEST_CASE("where there is no surface nothing is found, and the vertex stays") {
    Points points(3, 4);
    points << 0.0, 1.0, 0.0, 5.0, 0.0, 0.0, 1.0, 5.0, 0.0, 0.0, 0.0, 5.0;
    Triangles triangles(3, 1);
    triangles << 0, 1, 2;
    const LowPass smooth = low_pass(points, triangles, {0, 3}, 1.0);
    CHECK(smooth.found == std::vector<char>{0, 0});
    CHECK(smooth.points.col(1) == points.col(3));
    CHECK(smooth.normals.isZero(0.0));
}
