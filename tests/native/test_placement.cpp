#include <doctest/doctest.h>

#include "geometry/flips.h"
#include "meshes.h"
#include "placement/first_placement.h"
#include "placement/relax.h"
#include "placement/tears.h"
#include "placement/untangle.h"
#include "problem/surface_state.h"
#include "tangential/slide.h"

using namespace fairing;

namespace {

// A flat square that carries vertices of its own connectivity.
struct Square {
    explicit Square(int n = 12) : single(test::single_patch(test::grid(n, 0.0, test::flat))) {}

    test::Single single;
    Points normals = Vector3::UnitZ().replicate(1, single.points.cols());
    TargetSurface target{single.patch(), single.points, normals};
    Problem problem = make_problem(uniform_weights(single.patch()));

    [[nodiscard]] const Patch& patch() const { return single.patch(); }

    [[nodiscard]] Problem make_problem(Lambda weights) const {
        const Eigen::Index fixed = patch().vertex_count() - patch().free_count;
        return {patch(), single.points.rightCols(fixed), normals.rightCols(fixed), std::move(weights), {}};
    }

    [[nodiscard]] Placement placed(const Points& points) const {
        Placement placement = at_vertices(problem, target, single.points);
        for (int v = 0; v < patch().free_count; ++v)
            put(placement, v, target, target.project(points.col(v), placement.where[v].triangle));
        return placement;
    }

    // The inner vertices turned round the middle, those in the middle by most: folded, but smoothly.
    [[nodiscard]] Placement twirled(double turn) const {
        Points points = single.points;
        for (int v = 0; v < patch().free_count; ++v) {
            const Vector3 away = points.col(v) - Vector3(0.5, 0.5, 0.0);
            const double angle = away.norm() < 0.3 ? turn : 0.0;
            points.col(v) = Vector3(0.5, 0.5, 0.0) + Eigen::AngleAxisd(angle, Vector3::UnitZ()) * away;
        }
        return placed(points);
    }

    [[nodiscard]] std::size_t folds(const Placement& placement) const {
        return folded_triangles(problem, target, placement).size();
    }
};

}  // namespace

TEST_CASE("vertices slide on a surface to where their springs balance") {
    const Square square;
    Placement placement = square.twirled(0.3);
    const auto springs = make_tangential_step(square.patch(), square.problem.weights, square.problem.fixed_points, {});
    slide_on(square.target, *springs, 20, placement.where, placement.points);
    const Points off = placement.points.leftCols(square.patch().free_count) - springs->harmonic_positions();
    CHECK(largest_length(off) < 1e-3);
    CHECK(placement.points.row(2).cwiseAbs().maxCoeff() < 1e-12);
    for (int v = 0; v < square.patch().free_count; ++v)
        CHECK((square.target.position(placement.where[v]) - placement.points.col(v)).norm() < 1e-12);
}

TEST_CASE("a sheet that lies on the other one is folded, although no triangle differs from its neighbours") {
    const Square square;
    Points mirrored = square.single.points;
    mirrored.row(0) = 1.0 - mirrored.row(0).array();
    const Placement placement = square.placed(mirrored);
    int inner = 0;
    int seen_by_neighbours = 0;
    for (int t = 0; t < square.patch().triangle_count(); ++t) {
        if (square.patch().triangles.col(t).maxCoeff() >= square.patch().free_count) continue;
        ++inner;
        CHECK(is_folded(square.problem, square.target, placement, t));
    }
    for (const int t : flipped_by_solution(square.patch(), placement.points)) {
        seen_by_neighbours += square.patch().triangles.col(t).maxCoeff() < square.patch().free_count ? 1 : 0;
    }
    CHECK(inner > 100);
    CHECK(seen_by_neighbours == 0);
}

TEST_CASE("a refill restores a plane around a vertex pulled out of it, and nothing else moves") {
    const Square square;
    const Patch& patch = square.patch();
    Points points = square.single.points;
    const int pulled = patch.free_count / 2;
    points.col(pulled) += Vector3(0.4, -0.3, 2.0);
    Indices around;
    for (int t = 0; t < patch.triangle_count(); ++t) {
        if ((patch.triangles.col(t).array() == pulled).any()) around.push_back(t);
    }
    points.col(0).z() += 1e-3;  // a corner, far from them
    for (const int rings : {0, 1}) {
        const Points result = refilled(patch, points, around, rings);
        CHECK((result.col(pulled) - square.single.points.col(pulled)).norm() < 1e-12);
        const bool kept = result.col(0) == points.col(0);
        CHECK(kept);
    }
}
