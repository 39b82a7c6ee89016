#include <doctest/doctest.h>

#include "fillet/row_cut.h"

using namespace fairing;

namespace {

// A square of two triangles within a fillet.
SplitMesh square() {
    SplitMesh cut;
    cut.triangles.resize(3, 2);
    cut.triangles.col(0) << 0, 1, 2;
    cut.triangles.col(1) << 0, 2, 3;
    cut.parent = {0, 1};
    cut.inside = {1, 1};
    return cut;
}

}  // namespace

TEST_CASE("rows: quads that leave the border of a fillet are none") {
    CHECK_NOTHROW(check_border(square(), {}, {{0, 1, 2, 3}}));
    CHECK_THROWS_AS(check_border(square(), {}, {{4, 1, 2, 3}}), NoRows);
    CHECK_THROWS_AS(check_border(square(), {}, {{0, 1, 2, 3}, {0, 1, 2, 3}}), NoRows);
}

TEST_CASE("rows: a concave quad has an angle above 180 degrees") {
    Points points(3, 5);
    points << 0.0, 1.0, 1.0, 0.0, 0.7,  //
        0.0, 0.0, 1.0, 1.0, 0.7,        //
        0.0, 0.0, 0.0, 0.0, 0.0;
    CHECK(widest_angle({0, 1, 2, 3}, points) == doctest::Approx(90.0));
    CHECK(widest_angle({1, 2, 3, 4}, points) > 180.0);
}

TEST_CASE("rows: pieces outside close up over a point that goes, and none turns over") {
    // 1 lies between 0 and 2 on the border of the fillet; 3 and 4 are beyond
    Points points(3, 5);
    points << 0.0, 1.0, 2.0, 0.5, 1.5,  //
        0.0, 0.0, 0.0, -1.0, -1.0,      //
        0.0, 0.0, 0.0, 0.0, 0.0;
    SplitMesh cut;
    cut.triangles.resize(3, 3);
    cut.triangles.col(0) << 1, 0, 3;
    cut.triangles.col(1) << 1, 3, 4;
    cut.triangles.col(2) << 2, 1, 4;
    cut.parent = {0, 1, 2};
    cut.inside = {0, 0, 0};
    cut.line = {{0, 1}, {1, 2}};
    drop_points(points, {1}, cut);
    CHECK(cut.triangles.cols() == 2);
    CHECK(cut.line == std::vector<VertexPair>{{0, 2}});
    CHECK((cut.triangles.array() != 1).all());
}
