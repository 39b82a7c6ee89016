#include <doctest/doctest.h>

#include "geometry/self_intersection.h"
#include "meshes.h"
#include "placement/first_placement.h"
#include "placement/place.h"
#include "problem/surface_state.h"

using namespace fairing;

TEST_CASE("through the disc every vertex of a mesh comes to itself") {
    const test::Single single = test::single_patch(test::grid(12, 0.3, test::sphere));
    const Patch& patch = single.patch();
    const Points normals =
        max_normals(patch, single.points, single.points.rightCols(patch.vertex_count() - patch.free_count));
    const TargetSurface target(patch, single.points, normals);
    const Problem problem{patch,
                          single.points.rightCols(patch.vertex_count() - patch.free_count),
                          normals.rightCols(patch.vertex_count() - patch.free_count),
                          uniform_weights(patch),
                          {}};
    const auto placement = by_disc(problem, patch, target);
    REQUIRE(placement.has_value());
    CHECK(largest_length(placement->points - single.points) < 1e-9);
}

TEST_CASE("a mesh with a fixed vertex inside is not laid out in a disc") {
    const test::Mesh mesh = test::grid(6, 0.0, test::flat);
    std::vector<char> given(static_cast<std::size_t>(mesh.points.cols()), 0);
    given[24] = 1;
    const test::Single single = test::single_patch(mesh, given);
    const Patch& patch = single.patch();
    const Points normals = Vector3::UnitZ().replicate(1, single.points.cols());
    const Eigen::Index fixed = patch.vertex_count() - patch.free_count;
    REQUIRE(fixed == 25);
    const TargetSurface target(patch, single.points, normals);
    const Problem problem{patch, single.points.rightCols(fixed), normals.rightCols(fixed), uniform_weights(patch), {}};
    CHECK_FALSE(by_disc(problem, patch, target).has_value());
}
