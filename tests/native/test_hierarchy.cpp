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

}  // namespace

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
