#include <doctest/doctest.h>

#include "base/errors.h"
#include "mesh/loops.h"
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

TEST_CASE("every side lies on one edge, and the edge knows it") {
    const Triangles triangles = test::grid(4, 0.0, test::flat).triangles;
    const EdgeTable edges = make_edges(triangles, 25);
    CHECK(25 - edges.size() + triangles.cols() == 1);  // Euler number of a disc
    for (int e = 0; e < edges.size(); ++e) {
        for (int k = 0; k < edges.side_count(e); ++k) {
            const int s = edges.side(e, k);
            CHECK(edges.edge_of_side[static_cast<std::size_t>(s)] == e);
            CHECK(std::min(side_tail(triangles, s), side_head(triangles, s)) ==
                  edges.ends[static_cast<std::size_t>(e)][0]);
        }
    }
}

TEST_CASE("a fixed equator splits an octahedron into two pieces with vertices of their own") {
    Diagnostics warnings;
    const CutMesh mesh = cut(octahedron(), {1, 1, 1, 1, 0, 0}, warnings);
    CHECK(mesh.piece_count == 2);
    CHECK(mesh.input_vertex.size() == 10);
    CHECK(warnings.empty());
}

TEST_CASE("a lone fixed edge and a pin cut nothing") {
    Diagnostics warnings;
    CHECK(cut(octahedron(), {1, 1, 0, 0, 0, 0}, warnings).input_vertex.size() == 6);
    CHECK(cut(octahedron(), {0, 0, 0, 0, 1, 0}, warnings).piece_count == 1);
}

TEST_CASE("an open curve of two edges is slit: its middle is doubled, its ends are not") {
    Diagnostics warnings;
    const CutMesh mesh = cut(octahedron(), {1, 1, 1, 0, 0, 0}, warnings);
    CHECK(mesh.piece_count == 1);
    CHECK(mesh.input_vertex.size() == 7);
}

TEST_CASE("the triangle in a corner of the border stays with its patch") {
    // All diagonals point one way: at two corners of the square they are chords between vertices of the border.
    const test::Single single = test::single_patch(test::grid(4, 0.0, test::flat, false));
    CHECK(single.patches.size() == 1);
    CHECK(single.patch().triangle_count() == 32);
}

TEST_CASE("a single triangle wound the other way is found and turned round") {
    Triangles triangles = octahedron();
    triangles.col(3).reverseInPlace();
    Diagnostics warnings;
    const CutMesh mesh = cut(triangles, {1, 1, 1, 1, 0, 0}, warnings);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].code == Code::inconsistent_winding);
    CHECK(warnings[0].elements == Indices{3});
    const EdgeTable edges = make_edges(mesh.triangles, static_cast<int>(mesh.input_vertex.size()));
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) != 2) continue;
        CHECK(side_tail(mesh.triangles, edges.side(e, 0)) == side_head(mesh.triangles, edges.side(e, 1)));
    }
}

TEST_CASE("a Möbius strip with free vertices is refused") {
    // Two rows of quads around a strip whose last column meets the first upside down.
    constexpr int columns = 8;
    const auto vertex = [](int column, int row) { return column < columns ? 3 * column + row : 2 - row; };
    Triangles triangles(3, 4 * columns);
    int t = 0;
    for (int c = 0; c < columns; ++c) {
        for (int r = 0; r < 2; ++r) {
            triangles.col(t++) << vertex(c, r), vertex(c + 1, r), vertex(c + 1, r + 1);
            triangles.col(t++) << vertex(c, r), vertex(c + 1, r + 1), vertex(c, r + 1);
        }
    }
    Diagnostics warnings;
    try {
        cut(triangles, std::vector<char>(3 * columns, 0), warnings);
        FAIL("not refused");
    } catch (const MeshError& error) {
        CHECK(error.diagnostic().code == Code::not_orientable);
        CHECK(error.diagnostic().kind == ElementKind::triangle);
    }
}

TEST_CASE("boundary loops keep the mesh on their left") {
    const std::vector<Indices> loops = boundary_loops(test::grid(2, 0.0, test::flat).triangles, 9);
    REQUIRE(loops.size() == 1);
    CHECK(loops[0] == Indices{0, 1, 2, 5, 8, 7, 6, 3});
}

TEST_CASE("two squares that share a corner have two loops") {
    Triangles triangles(3, 2);
    triangles << 0, 2,  //
        1, 3,           //
        2, 4;
    CHECK(boundary_loops(triangles, 5) == std::vector<Indices>{{0, 1, 2}, {2, 3, 4}});
}
