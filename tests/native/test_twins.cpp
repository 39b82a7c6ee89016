#include <doctest/doctest.h>

#include "base/errors.h"
#include "mesh/loops.h"
#include "mesh/pieces.h"
#include "meshes.h"

using namespace fairing;

namespace {

// Given as they come out of a cut mesh, and from the vertices alone.
Twins found(const Triangles& triangles, int vertex_count) {
    Twins twins;
    REQUIRE_FALSE(find_twins(triangles, vertex_count, twins));
    return twins;
}

PatchMembers members_of(const Triangles& triangles, int vertex_count) {
    PatchMembers members;
    for (int v = 0; v < vertex_count; ++v) members.to_input.push_back(v);
    for (int t = 0; t < static_cast<int>(triangles.cols()); ++t) members.input_triangle.push_back(t);
    members.pin.assign(vertex_count, 0);
    members.triangles = triangles;
    return members;
}

// Three triangles on the edge 0–1.
Triangles fin() {
    Triangles t(3, 3);
    t << 0, 1, 0,  //
        1, 0, 1,   //
        2, 3, 4;
    return t;
}

}  // namespace

TEST_CASE("a patch is the same with the twins of the mesh that it was cut from, whichever way that was wound") {
    test::Mesh mesh = test::grid(6, 0.2, test::sphere);
    for (const int t : {3, 17, 40}) std::swap(mesh.triangles(1, t), mesh.triangles(2, t));
    const test::Single single = test::single_patch(mesh);
    REQUIRE(single.cut.twins == found(single.cut.triangles, static_cast<int>(single.cut.input_vertex.size())));
    const Patch& patch = single.patch();
    const Patch alone(static_cast<const PatchMembers&>(patch));
    CHECK(patch.triangle_edges == alone.triangle_edges);
    CHECK(patch.edge_ends == alone.edge_ends);
    CHECK(patch.edge_triangles == alone.edge_triangles);
    for (int v = 0; v < patch.vertex_count(); ++v) {
        CHECK(std::ranges::equal(patch.ring(v).vertices, alone.ring(v).vertices));
        CHECK(std::ranges::equal(patch.ring(v).spokes, alone.ring(v).spokes));
        CHECK(std::ranges::equal(patch.ring(v).rim, alone.ring(v).rim));
    }
}

TEST_CASE("sides that run to and fro between two vertices are joined, more than two or alike are misfits") {
    Triangles pair(3, 2);
    pair << 0, 1,  //
        1, 0,      //
        2, 3;
    Twins twins(6, none);
    CHECK_FALSE(join_borders(pair, twins));
    CHECK(twins[0] == 3);
    CHECK(twins[3] == 0);

    Twins none_yet(9, none);
    CHECK(join_borders(fin(), none_yet).has_value());
    Twins searched;
    CHECK(find_twins(fin(), 5, searched).has_value());

    std::swap(pair(0, 1), pair(1, 1));
    Twins alike(6, none);
    CHECK(join_borders(pair, alike).has_value());
}

TEST_CASE("a patch refuses twins that leave an edge twice, or a vertex between two fans") {
    // Two triangles on the same three vertices, joined along one edge.
    Triangles pocket(3, 2);
    pocket << 0, 1,  //
        1, 0,        //
        2, 2;
    Twins one_edge{3, none, none, 0, none, none};
    CHECK_NOTHROW(Patch(members_of(pocket, 3), one_edge));  // the borders close it
    // A fan of 0 that passes 1 twice.
    Triangles twice(3, 4);
    twice << 0, 0, 0, 0,  //
        1, 2, 1, 3,       //
        2, 1, 3, 1;
    const Twins round{11, none, 3, 2, none, 6, 5, none, 9, 8, none, 0};
    CHECK_THROWS_AS(Patch(members_of(twice, 4), round), MeshError);
    Triangles fans(3, 2);
    fans << 0, 0,  //
        1, 3,      //
        2, 4;
    CHECK_THROWS_AS(Patch(members_of(fans, 5), Twins(6, none)), MeshError);
}
