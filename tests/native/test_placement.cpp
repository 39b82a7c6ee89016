#include <doctest/doctest.h>

#include "geometry/flips.h"
#include "meshes.h"
#include "placement/first_placement.h"
#include "placement/tears.h"
#include "problem/surface_state.h"

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
};

}  // namespace

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
