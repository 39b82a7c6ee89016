#include <doctest/doctest.h>

#include "fillet/row_cut.h"
#include "fillet/row_surface.h"

using namespace fairing;

TEST_CASE("rows: a gap between two chains is filled with triangles that are not turned over") {
    Points points(3, 5);                // 0, 1, 2 on the right, 3, 4 on the left of them
    points << 1.0, 1.0, 1.0, 0.0, 0.0,  //
        0.0, 1.0, 2.0, 0.0, 2.0,        //
        0.0, 0.0, 0.0, 0.0, 0.0;
    const auto place = [&](int v) { return Vector3(points.col(v)); };
    const auto up = [](double z) { return [z](int) { return Vector3(0.0, 0.0, z); }; };
    CHECK(roundest({0, 1, 2, 4, 3}, place, up(1.0), 1e-3).size() == 3);
    CHECK(roundest({0, 1, 2, 4, 3}, place, up(-1.0), 1e-3).empty());
}

TEST_CASE("rows: a concave quad has an angle above 180 degrees") {
    Points points(3, 5);
    points << 0.0, 1.0, 1.0, 0.0, 0.7,  //
        0.0, 0.0, 1.0, 1.0, 0.7,        //
        0.0, 0.0, 0.0, 0.0, 0.0;
    const auto at = [&](int v) { return Vector3(points.col(v)); };
    CHECK(widest_angle({at(0), at(1), at(2), at(3)}) == doctest::Approx(90.0));
    CHECK(widest_angle({at(1), at(2), at(3), at(4)}) > 180.0);
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
    ClosedPieces pieces(points, cut);
    CHECK(pieces.drop({1}));
    CHECK_FALSE(pieces.drop({0}));
    pieces.finish();
    CHECK(cut.triangles.cols() == 2);
    CHECK(cut.line == std::vector<VertexPair>{{0, 2}});
    CHECK((cut.triangles.array() != 1).all());
}
