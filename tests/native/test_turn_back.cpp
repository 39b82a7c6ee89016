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

// A vertex in the middle of a flat hexagon, whose corners stand off it.
struct Star {
    explicit Star(const std::array<int, 6>& heights) {
        for (Eigen::Index k = 0; k < 6; ++k)
            problem.fixed_points(2, k) = heights[single.patch().to_input[static_cast<std::size_t>(k) + 1]];
    }

    static test::Mesh hexagon() {
        test::Mesh mesh{Points::Zero(3, 7), Triangles(3, 6)};
        for (int k = 0; k < 6; ++k) {
            mesh.points.col(k) << std::cos(k * std::numbers::pi / 3.0), std::sin(k * std::numbers::pi / 3.0), 0.0;
            mesh.triangles.col(k) << k, (k + 1) % 6, 6;
        }
        return mesh;
    }

    test::Single single = test::single_patch(hexagon());
    Points normals = Vector3::UnitZ().replicate(1, 7);
    TargetSurface target{single.patch(), single.points, normals};
    Problem problem{
        single.patch(), single.points.rightCols(6), normals.rightCols(6), uniform_weights(single.patch()), {}};
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

TEST_CASE("a vertex across a sharp ridge is brought back where untangling folds more") {
    const auto ridge = [](double u, double w) { return Vector3(u, w, -8.0 * std::abs(u - 0.5)); };
    const test::Single single = test::single_patch(test::grid(14, 0.0, ridge));
    const Patch& patch = single.patch();
    const Points ends = single.points.rightCols(patch.vertex_count() - patch.free_count);
    const Points normals = max_normals(patch, single.points, Points::Zero(3, ends.cols()));
    const TargetSurface target(patch, single.points, normals);
    const Problem problem{patch, ends, normals.rightCols(ends.cols()), uniform_weights(patch), {}};
    const auto springs = make_tangential_step(patch, problem.weights, ends, {});
    for (const int pick : {0, 1, 3, 4, 5}) {
        Placement start = at_vertices(problem, target, single.points);
        const int vertex = patch.free_count / 3 + 7 * pick;
        const int other = patch.ring(vertex).vertices[pick % 4];
        const Vector3 there = start.points.col(vertex) + 1.7 * (start.points.col(other) - start.points.col(vertex));
        put(start, vertex, target, target.project(there, start.where[vertex].triangle));
        REQUIRE(folds_of_placement(problem, target, start).size() > 10);
        CHECK(place_settled(problem, *springs, target, start, {}).folded.empty());
    }
}

TEST_CASE("nothing is tried where nothing is folded, or a whole sheet") {
    const Square square;
    Placement even = square.start();
    CHECK_FALSE(turn_back(square.problem, square.target, even));
    CHECK(even.points == square.single.points);
    Placement mirrored = square.start();
    for (int v = 0; v < square.single.patch().free_count; ++v) {
        Vector3 there = square.single.points.col(v);
        there.x() = 1.0 - there.x();
        put(mirrored, v, square.target, square.target.project(there, mirrored.where[v].triangle));
    }
    const Points before = mirrored.points;
    REQUIRE(square.folds(mirrored) > few_folds);
    CHECK_FALSE(turn_back(square.problem, square.target, mirrored));
    CHECK(mirrored.points == before);
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

TEST_CASE("triangles at a jagged outline that only their neighbours speak against are turned back") {
    for (const auto& heights :
         {std::array{0, -1, 3, -2, 3, -3}, std::array{1, 1, 3, -1, 3, 1}, std::array{1, -3, 2, 2, -2, 1}}) {
        const Star star(heights);
        const auto springs =
            make_tangential_step(star.problem.patch, star.problem.weights, star.problem.fixed_points, {});
        const Placement start =
            placed_at(star.problem, star.target, at_vertices(star.problem, star.target, star.single.points).where);
        REQUIRE(folds_of_placement(star.problem, star.target, start).empty());
        REQUIRE(!folded_triangles(star.problem, star.target, start).empty());
        const Placed placed = place_settled(star.problem, *springs, star.target, start, {});
        CHECK(folded_triangles(star.problem, star.target, placed.placement).empty());
    }
}
