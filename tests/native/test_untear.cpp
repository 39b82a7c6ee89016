// Triangles beside an outline that are turned over or pass through others.
#include <doctest/doctest.h>

#include "meshes.h"
#include "placement/tears.h"
#include "placement/untear.h"

using namespace fairing;

TEST_CASE("what is turned over beside the outline is filled anew, and what is far from it stays") {
    const test::Single single = test::single_patch(test::grid(30, 0.2, test::sphere));
    const Patch& patch = single.patch();
    Points points = single.points;
    CHECK(torn_triangles(patch, points).empty());
    test::push_beyond_outline(patch, 5, points);
    REQUIRE(torn_triangles(patch, points).size() >= 5);
    const Points result = untorn(patch, points);
    CHECK(torn_triangles(patch, result).empty());
    const int fixed = patch.vertex_count() - patch.free_count;
    CHECK((result.rightCols(fixed) - points.rightCols(fixed)).isZero(0.0));
    int moved = 0;
    for (int v = 0; v < patch.free_count; ++v) moved += result.col(v) != points.col(v) ? 1 : 0;
    CHECK(moved < patch.free_count / 3);
    const double off = (result.colwise().norm().array() - 1.0).abs().maxCoeff();
    CHECK(off < 0.02);
}

TEST_CASE("a vertex that no filling brings back is tried elsewhere") {
    // The outline's tooth, bent inwards over the row behind it: evenly filled vertices lie under it.
    const test::Single single = test::single_patch(test::grid(12, 0.0, test::flat));
    const Patch& patch = single.patch();
    Points points = single.points;
    int tooth = patch.free_count;
    for (int v = tooth; v < patch.vertex_count(); ++v) {
        if ((points.col(v) - Vector3(0.5, 0.0, 0.0)).norm() < (points.col(tooth) - Vector3(0.5, 0.0, 0.0)).norm())
            tooth = v;
    }
    points(1, tooth) += 0.2;
    REQUIRE(!torn_triangles(patch, points).empty());
    const Points result = untorn(patch, points);
    CHECK(torn_triangles(patch, result).empty());
    CHECK(result.col(tooth) == points.col(tooth));
}

TEST_CASE("tears are kept up to date while vertices move") {
    const test::Single single = test::single_patch(test::grid(20, 0.3, test::sphere));
    const Patch& patch = single.patch();
    Points points = single.points;
    Tears tears(patch, points);
    const auto shift = [&](int first, int step, const Vector3& by) {
        Indices moved;
        for (int v = first; v < patch.free_count; v += step) {
            points.col(v) += by;
            moved.push_back(v);
        }
        tears = tears.after(points, moved);
        CHECK(tears.triangles() == torn_triangles(patch, points));
        return tears.count();
    };
    CHECK(tears.count() == 0);
    CHECK(shift(0, 37, {0.12, 0.1, 0.0}) > 0);   // over their neighbours
    CHECK(shift(1, 53, {0.3, -0.2, -0.1}) > 0);  // and others through triangles farther off
    CHECK(shift(0, 37, {-0.12, -0.1, 0.0}) > 0);
    CHECK(shift(1, 53, {-0.3, 0.2, 0.1}) == 0);
}

TEST_CASE("what is not torn is left as it is, to the bit") {
    const test::Single single = test::single_patch(test::grid(12, 0.3, test::sphere));
    CHECK((untorn(single.patch(), single.points) - single.points).isZero(0.0));
}
