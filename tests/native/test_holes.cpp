#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

#include "api/fill.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "fill/proportion.h"
#include "fill/short_edges.h"
#include "geometry/segments.h"
#include "mesh/hole_loops.h"
#include "meshes.h"

using namespace fairing;

namespace {

// The triangles of a grid of n × n squares but those around some of its vertices (their column and row).
test::Mesh grid_without(int n, const std::vector<std::array<int, 2>>& gone,
                        const std::function<Vector3(double, double)>& surface = test::sphere) {
    test::Mesh mesh = test::grid(n, 0.0, surface);
    Indices kept;
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
        const auto corners = mesh.triangles.col(t);
        const bool is_gone = std::any_of(gone.begin(), gone.end(), [&](const auto& at) {
            return (corners.array() == at[1] * (n + 1) + at[0]).any();
        });
        if (!is_gone) kept.push_back(static_cast<int>(t));
    }
    mesh.triangles = Triangles(mesh.triangles(Eigen::all, kept));
    return mesh;
}

HoleLoops loops_of(const test::Mesh& mesh) {
    return hole_loops(mesh.points, mesh.triangles, border_sides(mesh.triangles, static_cast<int>(mesh.points.cols())));
}

}  // namespace

TEST_CASE("segments: edges that cross, vertices on edges and on each other") {
    Points points(3, 6);
    points << 0.0, 1.0, 0.5, 0.5, 0.5, 0.0,  //
        0.0, 0.0, -1.0, 1.0, 0.0, 0.0,       //
        0.0, 0.0, 0.0, 0.0, 0.0, 1e-9;
    CHECK(crossing_edges({{0, 1}, {2, 3}}, points).size() == 1);
    CHECK(crossing_edges({{0, 1}, {1, 2}}, points).empty());
    CHECK(touching_edges({{0, 1}, {4, 3}}, points).on_edges == std::vector<std::array<int, 3>>{{0, 1, 4}});
    CHECK(touching_edges({{0, 1}, {5, 3}}, points).pairs == VertexPairs{{0, 5}});
}

TEST_CASE("short edges: vertices left out come back in their order") {
    constexpr int count = 12;
    LoopShape shape{Points(3, count + 2), Points(3, count + 2)};
    Indices loop;
    for (int k = 0; k < count + 2; ++k) {
        const double angle = (k < 2 ? 1e-3 * k : k - 2 + (k == 2 ? 2e-3 : 0.0)) * 2.0 * std::numbers::pi / count;
        shape.points.col(k) << std::cos(angle), std::sin(angle), 0.0;
        loop.push_back(k);
    }
    shape.normals.colwise() = Vector3::UnitZ();
    ThinnedLoops thin;
    add_thinned(thin, loop, shape);
    CHECK(thin.loops[0].size() == count);
    REQUIRE(thin.left_out.size() == 2);
    CHECK(thin.left_out[0][1] + 1 == thin.left_out[1][1]);
}

TEST_CASE("proportion: a search in vain gets no large mesh") {
    const Limit limit = Limit::of(210.0, 0);
    limit.check(20'000.0, {});
    CHECK_THROWS_AS(limit.check(20'000.0, {1, 2}, false), MeshError);
    CHECK_THROWS_AS(limit.check(60'000.0, {1, 2}), MeshError);
    Limit::of(210.0, 100'000).check(60'000.0, {}, false);
}

TEST_CASE("fill: triangles that stand up from the border leave a hole a hole") {
    test::Mesh mesh = grid_without(16, {{8, 8}});
    const Indices hole = loops_of(mesh).loops.back();
    const auto count = static_cast<int>(mesh.points.cols());
    const int flaps = static_cast<int>(hole.size()) / 2;
    mesh.points.conservativeResize(3, count + flaps);
    mesh.triangles.conservativeResize(3, mesh.triangles.cols() + flaps);
    for (int k = 0; k < flaps; ++k) {
        const Vector3 middle = 0.5 * (mesh.points.col(hole[2 * k]) + mesh.points.col(hole[2 * k + 1]));
        mesh.points.col(count + k) = 1.08 * middle;
        mesh.triangles.rightCols(flaps - k).col(0) << hole[2 * k], hole[2 * k + 1], count + k;
    }
    std::vector<Indices> loops = loops_of(mesh).loops;
    std::erase_if(loops, [&](const Indices& loop) { return *std::max_element(loop.begin(), loop.end()) < count; });
    REQUIRE(loops.size() == 1);
    CHECK(!is_outer(loop_shapes(HoledMesh({mesh.points, mesh.triangles}), loops)[0]));
}
