#include <doctest/doctest.h>

#include <array>
#include <random>
#include <set>
#include <span>
#include <utility>

#include "geometry/box_tree.h"
#include "meshes.h"

using namespace fairing;

namespace {

// Triangles without common vertices, as long as the ball is wide that they lie in: most boxes overlap.
test::Mesh crumpled(int count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    test::Mesh mesh{Points(3, 3 * count), Triangles(3, count)};
    for (double& x : mesh.points.reshaped()) x = place(random);
    for (int k = 0; k < 3 * count; ++k) mesh.triangles(k % 3, k / 3) = k;
    return mesh;
}

using Box = std::array<Vector3, 2>;

Box box_of(const test::Mesh& mesh, int t) {
    const auto corners = mesh.points(Eigen::all, mesh.triangles.col(t));
    return {corners.rowwise().minCoeff(), corners.rowwise().maxCoeff()};
}

bool overlap(const Box& a, const Box& b) {
    return (a[0].array() < b[1].array()).all() && (b[0].array() < a[1].array()).all();
}

using Pairs = std::set<std::pair<int, int>>;

}  // namespace

TEST_CASE("each pair of boxes that overlap is visited once; those of two known triangles may be left out") {
    constexpr int count = 300;
    test::Mesh mesh = crumpled(count);
    // The first half lies to the left, so that nodes of the tree are decided, and reaches into the second.
    for (int t = 0; t < count; ++t) {
        for (const int v : mesh.triangles.col(t)) mesh.points(0, v) += t < count / 2 ? -0.9 : 0.9;
    }
    const auto is_settled = [](int t) { return t < count / 2; };
    Pairs open;  // with one that is not decided
    for (int a = 0; a < count; ++a) {
        for (int b = 0; b < a; ++b) {
            if (!is_settled(a) && overlap(box_of(mesh, a), box_of(mesh, b))) open.emplace(b, a);
        }
    }
    REQUIRE(open.size() > count);
    int twice = 0;
    int decided = 0;
    const BoxTree tree(mesh.triangles, mesh.points);
    Pairs visited;
    tree.for_overlaps(
        [&](int t, std::span<const int> others) {
            for (const int other : others) {
                const std::pair<int, int> pair = std::minmax(t, other);
                if (is_settled(pair.first) && is_settled(pair.second)) {
                    ++decided;
                } else if (!visited.insert(pair).second) {
                    ++twice;
                }
            }
            return true;
        },
        is_settled);
    CHECK(visited == open);
    CHECK(twice == 0);
    CHECK(decided < count * count / 16);
}
