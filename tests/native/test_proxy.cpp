#include <doctest/doctest.h>

#include <algorithm>

#include "geometry/target_surface.h"
#include "meshes.h"
#include "proxy/proxy_mesh.h"
#include "proxy/proxy_solver.h"

using namespace fairing;

namespace {

int euler_number(const Patch& patch) { return patch.vertex_count() - patch.edge_count() + patch.triangle_count(); }

double shortest_over_longest(const Patch& patch, const Points& points) {
    double shortest = 1e300;
    double longest = 0.0;
    for (const auto& [a, b] : patch.edge_ends) {
        const double length = (points.col(a) - points.col(b)).norm();
        shortest = std::min(shortest, length);
        longest = std::max(longest, length);
    }
    return shortest / longest;
}

// Normals of the unit sphere, and a patch on it.
struct Ball {
    test::Single single = test::single_patch(test::grid(12, 0.3, test::sphere));
    Points normals = single.points;
    TargetSurface surface{single.patch(), single.points, normals};
};

}  // namespace

TEST_CASE("adapting keeps the outline, the topology and the numbers of vertices") {
    const test::Single single = test::single_patch(test::grid(14, 0.4, test::sphere));
    ProxyMesh mesh(single.patch(), single.points);
    mesh.adapt({0.5, 1.0, 1000});
    const auto coarse = mesh.snapshot();
    CHECK(coarse.patch.free_count < single.patch().free_count);
    CHECK(euler_number(coarse.patch) == 1);
    CHECK(coarse.patch.free_count + static_cast<int>(mesh.removed().size()) ==
          single.patch().free_count + mesh.number_count() - single.patch().vertex_count());
    // All fixed vertices are there, where they were.
    const int fixed = single.patch().vertex_count() - single.patch().free_count;
    REQUIRE(coarse.patch.vertex_count() - coarse.patch.free_count == fixed);
    for (int k = 0; k < fixed; ++k) {
        const int number = coarse.patch.to_input[static_cast<std::size_t>(coarse.patch.free_count + k)];
        CHECK(number == single.patch().free_count + k);
        CHECK(coarse.points.col(coarse.patch.free_count + k) == single.points.col(number));
    }
}

TEST_CASE("a crumpled start becomes a mesh of even edges") {
    // The inner vertices sit in a heap a thousandth of the patch wide.
    test::Single single = test::single_patch(test::grid(10, 0.0, test::flat));
    for (int v = 0; v < single.patch().free_count; ++v) {
        single.points.col(v) = Vector3(0.5, 0.5, 0.0) + 1e-3 * (single.points.col(v) - Vector3(0.5, 0.5, 0.0));
    }
    ProxyMesh mesh(single.patch(), single.points);
    mesh.adapt({0.1, 1.0, 1000});
    const auto result = mesh.snapshot();
    CHECK(euler_number(result.patch) == 1);
    CHECK(shortest_over_longest(result.patch, result.points) > 0.25);
    CHECK(result.points.row(2).cwiseAbs().maxCoeff() < 1e-15);
    for (int t = 0; t < result.patch.triangle_count(); ++t) {
        const Vector3 a = result.points.col(result.patch.triangles(0, t));
        const Vector3 ab = result.points.col(result.patch.triangles(1, t)) - a;
        const Vector3 ac = result.points.col(result.patch.triangles(2, t)) - a;
        CHECK(ab.cross(ac).z() > 0.0);
    }
}

TEST_CASE("a walk across the surface ends at the nearest point") {
    const Ball ball;
    const Vector3 wanted = test::sphere(0.83, 0.21);
    const SurfacePoint found = ball.surface.project(wanted, 0);
    CHECK(found.weights.minCoeff() >= 0.0);
    CHECK(found.weights.sum() == doctest::Approx(1.0));
    CHECK((ball.surface.position(found) - wanted).norm() < 1e-3);
    // The same from anywhere else.
    const SurfacePoint again = ball.surface.project(wanted, ball.single.patch().triangle_count() - 1);
    CHECK(again.triangle == found.triangle);
}

TEST_CASE("curved triangles interpolate vertices and follow a sphere to third order") {
    const Ball ball;
    for (int v = 0; v < ball.single.patch().vertex_count(); ++v) {
        CHECK((ball.surface.position(ball.surface.at_vertex(v)) - ball.single.points.col(v)).norm() < 1e-15);
    }
    double curved = 0.0;
    double flat = 0.0;
    for (int t = 0; t < ball.single.patch().triangle_count(); ++t) {
        const SurfacePoint centre{t, Vector3::Constant(1.0 / 3.0)};
        curved = std::max(curved, std::abs(ball.surface.position(centre).norm() - 1.0));
        Vector3 mean = Vector3::Zero();
        for (int v : ball.single.patch().triangles.col(t)) mean += ball.single.points.col(v) / 3.0;
        flat = std::max(flat, std::abs(mean.norm() - 1.0));
    }
    CHECK(curved < 0.01 * flat);
}
