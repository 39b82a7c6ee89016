#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <set>

#include "meshes.h"
#include "paper/prolongation.h"

using namespace fairing;

namespace {

using Corners = std::array<int, 3>;

Corners rotated(Corners t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

// Triangles of a level in the patch's own vertices, each starting at its smallest vertex.
std::set<Corners> triangles_of(const Triangles& triangles, const Indices& numbers) {
    std::set<Corners> result;
    for (const auto t : triangles.colwise()) {
        const auto number = [&](int k) { return numbers[static_cast<std::size_t>(t[k])]; };
        result.insert(rotated({number(0), number(1), number(2)}));
    }
    return result;
}

Indices own_numbers(const Patch& patch) {
    Indices numbers(static_cast<std::size_t>(patch.vertex_count()));
    for (std::size_t v = 0; v < numbers.size(); ++v) numbers[v] = static_cast<int>(v);
    return numbers;
}

std::set<Corners> collapse(const std::set<Corners>& triangles, const Collapse& c) {
    std::set<Corners> result;
    for (Corners t : triangles) {
        std::replace(t.begin(), t.end(), c.removed, c.kept);
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) result.insert(rotated(t));
    }
    return result;
}

int euler_number(const Patch& patch) { return patch.vertex_count() - patch.edge_count() + patch.triangle_count(); }

}  // namespace

TEST_CASE("levels grow exponentially and keep the outline") {
    const test::Single single = test::single_patch(test::grid(40, 0.3, test::sphere));
    const Patch& patch = single.patch();
    const Hierarchy hierarchy = build_hierarchy(patch, single.points, 3);
    REQUIRE(hierarchy.level_count() == 3);
    const int fixed = patch.vertex_count() - patch.free_count;
    const Indices sizes = level_sizes(patch.free_count, fixed, 3);
    for (int k = 0; k < 2; ++k) {
        const Patch& level = hierarchy.patches[static_cast<std::size_t>(k)];
        CHECK(level.vertex_count() - level.free_count == fixed);
        CHECK(level.free_count == sizes[static_cast<std::size_t>(k)]);
        CHECK(euler_number(level) == euler_number(patch));
    }
    CHECK(static_cast<double>(sizes[1]) / sizes[0] ==
          doctest::Approx(static_cast<double>(sizes[2]) / sizes[1]).epsilon(0.05));
}

TEST_CASE("the recorded collapses lead from the fine mesh to every level") {
    const test::Single single = test::single_patch(test::grid(16, 0.3, test::sphere));
    const Patch& patch = single.patch();
    const Hierarchy hierarchy = build_hierarchy(patch, single.points, 3);
    std::set<Corners> triangles = triangles_of(patch.triangles, own_numbers(patch));
    std::size_t made = 0;
    for (std::size_t k = hierarchy.patches.size(); k-- > 0;) {
        while (made < hierarchy.collapsed[k]) triangles = collapse(triangles, hierarchy.collapses[made++]);
        CHECK(triangles == triangles_of(hierarchy.patches[k].triangles, hierarchy.patches[k].to_input));
    }
}

TEST_CASE("coarse triangles are not distorted") {
    const test::Single single = test::single_patch(test::grid(30, 0.3, test::sphere));
    const Hierarchy hierarchy = build_hierarchy(single.patch(), single.points, 0);
    REQUIRE(hierarchy.level_count() > 1);
    const Patch& base = hierarchy.patches.front();
    for (const auto t : base.triangles.colwise()) {
        std::array<Vector3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = single.points.col(base.to_input[static_cast<std::size_t>(t[static_cast<int>(k)])]);
        }
        const double a = (p[1] - p[0]).norm();
        const double b = (p[2] - p[1]).norm();
        const double c = (p[0] - p[2]).norm();
        const double inner_radius = (p[1] - p[0]).cross(p[2] - p[0]).norm() / (a + b + c);
        CHECK(inner_radius / std::max({a, b, c}) > 0.05);
    }
}

TEST_CASE("prolongation puts new vertices close to the surface of the coarse level") {
    const test::Single single = test::single_patch(test::grid(24, 0.2, test::sphere));
    const Patch& patch = single.patch();
    const Hierarchy hierarchy = build_hierarchy(patch, single.points, 0);
    REQUIRE(hierarchy.level_count() > 1);
    const Points normals = single.points.rightCols(patch.vertex_count() - patch.free_count);
    const SolverOptions solver;
    const PaperOptions paper;
    const ProlongationSetting setting{patch, normals, single.points, InnerFairness::uniform, solver, paper};
    Prolongation prolongation(hierarchy, setting);
    Points points = single.points;
    for (const auto& c : hierarchy.collapses) points.col(c.removed).setConstant(99.0);
    prolongation.refine(hierarchy.level_count() - 1, points, Progress());
    const double spacing = 1.0 / 24;
    const VectorX away = (points.colwise().norm().array() - 1.0).abs();
    CHECK(away.maxCoeff() < 0.5 * spacing);
    CHECK(away.mean() < 0.1 * spacing);
}
