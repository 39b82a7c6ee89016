#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "meshes.h"
#include "paper/hierarchy.h"

using namespace fairing;
using namespace fairing::test;

namespace {

std::set<int> vertices_of(const Patch& patch) { return {patch.to_input.begin(), patch.to_input.end()}; }

}  // namespace

TEST_CASE(
    "levels of the hierarchy are nested discs of the same outline, as many as asked for, of about equal factors") {
    const Single single = single_patch(grid(40, 0.3, sphere));
    const Patch& patch = single.patch();
    for (const int levels : {1, 2, 3, 5}) {
        CHECK(build_hierarchy(patch, single.points, levels).level_count() == levels);
    }
    const Hierarchy hierarchy = build_hierarchy(patch, single.points, 4);
    std::set<int> finer = {};
    for (int v = 0; v < patch.vertex_count(); ++v) finer.insert(v);
    for (auto level = hierarchy.patches.rbegin(); level != hierarchy.patches.rend(); ++level) {
        const std::set<int> own = vertices_of(*level);
        CHECK(std::includes(finer.begin(), finer.end(), own.begin(), own.end()));
        CHECK(own.size() < 0.7 * static_cast<double>(finer.size()));
        for (int v = patch.free_count; v < patch.vertex_count(); ++v) CHECK(own.contains(v));
        CHECK(level->vertex_count() - level->edge_count() + level->triangle_count() == 1);
        CHECK(level->loop_count() == 1);
        finer = own;
    }
}
