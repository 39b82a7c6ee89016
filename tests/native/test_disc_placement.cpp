#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/self_intersection.h"
#include "meshes.h"
#include "placement/disc_placement.h"
#include "placement/place.h"
#include "problem/surface_state.h"

using namespace fairing;

namespace {

// A ball on a narrow neck over the unit square: most of a sphere, the outline around its lowest point.
Vector3 knob(const Vector3& flat) {
    constexpr double half_angle = 0.95 * std::numbers::pi;
    const Vector3 away = 2.0 * (flat - Vector3(0.5, 0.5, 0.0));
    const double around = std::atan2(away.y(), away.x());
    const double angle = half_angle * away.cwiseAbs().maxCoeff();
    return {std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around), std::cos(angle)};
}

Points knobs(const Points& flat) {
    Points result(3, flat.cols());
    for (Eigen::Index v = 0; v < flat.cols(); ++v) result.col(v) = knob(flat.col(v));
    return result;
}

// The inner vertices of a square anywhere in it: what a mesh that begins there remembers says nothing.
Points crumpled(const test::Single& single) {
    Points result = single.points;
    for (int v = 0; v < single.patch().free_count; ++v)
        result.col(v) << std::fmod(0.618034 * v, 1.0), std::fmod(0.754878 * v, 1.0), 0.0;
    return result;
}

// Inner vertices at the mean of their neighbours, the outline as it is.
Points evened(const Patch& patch, const Points& points) {
    Points result = points;
    const Points outline = points.rightCols(patch.vertex_count() - patch.free_count);
    result.leftCols(patch.free_count) =
        make_tangential_step(patch, uniform_weights(patch), outline, {})->harmonic_positions();
    return result;
}

// A knob with a mesh of its own, and a grid over the same outline whose vertices are to lie on it.
struct Knob {
    Knob() {
        mesh.adapt({0.3, 0.2, 1000});
        const auto start = mesh.snapshot();
        mesh.read_back(start.patch, knobs(evened(start.patch, start.points)));
        own.emplace(mesh.snapshot());
        normals = max_normals(own->patch, own->points, own->points.rightCols(problem.fixed_points.cols()));
        target.emplace(own->patch, own->points, normals);
    }

    test::Single single = test::single_patch(test::grid(36, 0.0, test::flat));
    ProxyMesh mesh{single.patch(), crumpled(single)};
    Points ends = knobs(single.points.rightCols(single.points.cols() - single.patch().free_count));
    Problem problem{single.patch(), ends, ends, uniform_weights(single.patch()), {}};
    std::optional<ProxyMesh::Snapshot> own;
    Points normals;
    std::optional<TargetSurface> target;
};

}  // namespace

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

TEST_CASE("vertices lie on a knob without folds although nothing tells where they belong") {
    const Knob knob;
    const auto springs = make_tangential_step(knob.problem.patch, knob.problem.weights, knob.problem.fixed_points, {});
    const Placed placed = place(knob.problem, *springs, {knob.mesh, *knob.own, *knob.target}, std::nullopt, {});
    CHECK(placed.folded.empty());
    CHECK(crossing_triangles(knob.problem.patch.triangles, placed.placement.points).empty());
}
