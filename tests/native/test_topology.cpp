#include <doctest/doctest.h>

#include <algorithm>

#include "api/input.h"
#include "base/errors.h"
#include "mesh/loops.h"
#include "mesh/pieces.h"
#include "mesh/twins.h"
#include "meshes.h"

using namespace fairing;

namespace {

CutMesh cut(const Triangles& triangles, const std::vector<char>& fixed, Diagnostics& warnings) {
    Indices kept;
    const Triangles clean = drop_collapsed_triangles(triangles, kept, warnings);
    const EdgeTable edges = make_edges(clean, static_cast<int>(fixed.size()));
    return cut_mesh(clean, edges, kept, classify_vertices(edges, {fixed, {}, {}}), warnings);
}

Triangles octahedron() {
    Triangles t(3, 8);
    t << 0, 1, 2, 3, 1, 2, 3, 0,  //
        1, 2, 3, 0, 0, 1, 2, 3,   //
        4, 4, 4, 4, 5, 5, 5, 5;
    return t;
}

}  // namespace

TEST_CASE("a fixed equator splits an octahedron into two pieces with vertices of their own") {
    Diagnostics warnings;
    const CutMesh mesh = cut(octahedron(), {1, 1, 1, 1, 0, 0}, warnings);
    CHECK(mesh.piece_count == 2);
    CHECK(mesh.input_vertex.size() == 10);
    CHECK(warnings.empty());
}

TEST_CASE("an open curve of two edges is slit: its middle is doubled, its ends are not") {
    Diagnostics warnings;
    const CutMesh mesh = cut(octahedron(), {1, 1, 1, 0, 0, 0}, warnings);
    CHECK(mesh.piece_count == 1);
    CHECK(mesh.input_vertex.size() == 7);
}

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

TEST_CASE("pieces are numbered by their lowest triangles, whatever their vertices") {
    // The second grid has the lower vertices, and the first the lower triangles.
    constexpr int n = 120;
    const test::Mesh mesh = test::grid(n, 0.0, test::flat);
    const auto count = static_cast<int>(mesh.points.cols());
    Points points(3, 2 * count);
    points << mesh.points, mesh.points;
    Triangles triangles(3, 2 * mesh.triangles.cols());
    triangles << (mesh.triangles.array() + count).matrix(), mesh.triangles;
    const CutMesh cut = check_topology({points, triangles, {}, {}}).cut;
    REQUIRE(cut.piece_count == 2);
    CHECK(cut.input_triangle.front() == mesh.triangles.cols());
    for (std::size_t t = 0; t < cut.piece.size(); t += 1000) {
        CHECK(cut.piece[t] == (cut.input_triangle[t] < mesh.triangles.cols() ? 0 : 1));
    }
}

TEST_CASE("triangles wound against most of their piece are found; a piece with one side has none") {
    Triangles mixed = octahedron();
    std::swap(mixed(0, 2), mixed(1, 2));
    std::swap(mixed(0, 5), mixed(1, 5));
    CHECK(turned_triangles(mixed, 6) == Indices{2, 5});
    CHECK(turned_triangles(octahedron(), 6).empty());
    Triangles strip(3, 5);  // a Möbius strip of five triangles
    for (int k = 0; k < 5; ++k) strip.col(k) << k, (k + 1) % 5, (k + 2) % 5;
    CHECK(turned_triangles(strip, 5).empty());
}
