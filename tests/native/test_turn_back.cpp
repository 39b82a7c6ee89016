#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "geometry/flips.h"
#include "meshes.h"
#include "placement/folds.h"
#include "placement/place.h"
#include "placement/turn_back.h"
#include "problem/surface_state.h"

using namespace fairing;

namespace {

// A flat square that carries vertices of its own connectivity.
struct Square {
    test::Single single = test::single_patch(test::grid(12, 0.0, test::flat));
    Points normals = Vector3::UnitZ().replicate(1, single.points.cols());
    TargetSurface target{single.patch(), single.points, normals};
    Points ends = single.points.rightCols(single.patch().vertex_count() - single.patch().free_count);
    Problem problem{
        single.patch(), ends, Vector3::UnitZ().replicate(1, ends.cols()), uniform_weights(single.patch()), {}};

    [[nodiscard]] Placement start() const { return at_vertices(problem, target, single.points); }
    [[nodiscard]] std::size_t folds(const Placement& placement) const {
        return folded_triangles(problem, target, placement).size();
    }

    // A vertex in the middle, put to the far side of a neighbour.
    [[nodiscard]] Placement with_one_across(int vertex) const {
        Placement placement = start();
        const int other = single.patch().ring(vertex).vertices[0];
        const Vector3 there =
            placement.points.col(vertex) + 1.7 * (placement.points.col(other) - placement.points.col(vertex));
        put(placement, vertex, target, target.project(there, placement.where[vertex].triangle));
        return placement;
    }
};

}  // namespace

TEST_CASE("one vertex across its neighbour is brought back, and no other moves") {
    const Square square;
    const int vertex = square.single.patch().free_count / 2;
    Placement placement = square.with_one_across(vertex);
    const Points before = placement.points;
    REQUIRE(square.folds(placement) > 0);
    REQUIRE(square.folds(placement) <= few_folds);
    CHECK(turn_back(square.problem, square.target, placement));
    CHECK(square.folds(placement) == 0);
    int moved = 0;
    for (int v = 0; v < square.single.patch().free_count; ++v) {
        moved += placement.points.col(v) != before.col(v) ? 1 : 0;
        CHECK((placement.points.col(v) - square.target.position(placement.where[v])).norm() == 0.0);
    }
    CHECK(moved <= 3);
}

TEST_CASE("a triangle is flipped alone as it is among all") {
    const Square square;
    const Placement placement = square.with_one_across(square.single.patch().free_count / 2);
    const Patch& patch = square.single.patch();
    Indices alone;
    for (int t = 0; t < patch.triangle_count(); ++t) {
        if (is_flipped(patch, placement.points, t)) alone.push_back(t);
    }
    CHECK(!alone.empty());
    CHECK(alone == flipped_triangles(patch, placement.points));
}
