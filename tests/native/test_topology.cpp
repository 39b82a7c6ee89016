#include <doctest/doctest.h>

#include <algorithm>

#include "api/input.h"
#include "base/errors.h"
#include "meshes.h"

using namespace fairing;

namespace {

// A permutation of 0 … count − 1 that leaves few neighbours together; `count` is no multiple of 7919.
Indices scattered(int count) {
    Indices order(count);
    for (int k = 0; k < count; ++k) order[k] = static_cast<int>(7919LL * k % count);
    return order;
}

}  // namespace

TEST_CASE("triangles that come in any order lie in that of the vertices, and are called what they were") {
    constexpr int n = 180;
    const test::Mesh mesh = test::grid(n, 0.0, test::flat);
    Triangles triangles(3, mesh.triangles.cols());
    const Indices order = scattered(static_cast<int>(triangles.cols()));
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) triangles.col(t) = mesh.triangles.col(order[std::size_t(t)]);
    const Indices turned{100, 20000, 60000};
    for (const int t : turned) triangles.col(t).reverseInPlace();
    const MeshTopology topology = check_topology({mesh.points, triangles, {}, {}});
    const CutMesh& cut = topology.cut;
    Indices seen(static_cast<int>(triangles.cols()), 0);
    int last = 0;
    bool same = true;
    bool ascending = true;
    for (int t = 0; t < cut.triangles.cols(); ++t) {
        Eigen::Vector3i corners = cut.triangles.col(t).unaryExpr([&](int v) { return cut.input_vertex[v]; });
        ascending = ascending && corners.minCoeff() >= last;
        last = corners.minCoeff();
        Eigen::Vector3i given = triangles.col(cut.input_triangle[t]);
        ++seen[cut.input_triangle[t]];
        std::sort(corners.begin(), corners.end());
        std::sort(given.begin(), given.end());
        same = same && corners == given;
    }
    CHECK(ascending);
    CHECK(same);
    CHECK(seen == Indices(seen.size(), 1));
    REQUIRE(topology.topology_warnings.size() == 1);
    CHECK(topology.topology_warnings[0].elements == turned);
}
