#include <doctest/doctest.h>

#include "mesh/surface_mesh.h"
#include "meshes.h"

using namespace fairing;

TEST_CASE("rings turn counter-clockwise and agree with the half-edge mesh") {
    const test::Single single = test::single_patch(test::grid(6, 0.2, test::flat));
    const Patch& patch = single.patch();
    const SurfaceMesh mesh = surface_mesh(patch);
    CHECK(static_cast<int>(mesh.n_edges()) == patch.edge_count());
    for (int v = 0; v < patch.vertex_count(); ++v) {
        const RingView ring = patch.ring(v);
        CHECK(ring.closed() == patch.is_free(v));
        CHECK(ring.valence() == mesh.valence(mesh.vertex_handle(static_cast<unsigned>(v))));
        for (std::size_t k = 0; k < ring.rim.size(); ++k) {
            const Vector3 a = single.points.col(ring.vertices[k]) - single.points.col(v);
            const Vector3 b = single.points.col(ring.vertices[(k + 1) % ring.valence()]) - single.points.col(v);
            CHECK(a.x() * b.y() - a.y() * b.x() > 0.0);
        }
    }
}

TEST_CASE("spokes and rims are the edges that they claim to be") {
    const test::Single single = test::single_patch(test::grid(5, 0.2, test::flat));
    const Patch& patch = single.patch();
    const auto has_ends = [&](int edge, int a, int b) {
        const auto& ends = patch.edge_ends[static_cast<std::size_t>(edge)];
        return (ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a);
    };
    for (int v = 0; v < patch.vertex_count(); ++v) {
        const RingView ring = patch.ring(v);
        for (std::size_t k = 0; k < ring.valence(); ++k) CHECK(has_ends(ring.spokes[k], v, ring.vertices[k]));
        for (std::size_t k = 0; k < ring.rim.size(); ++k) {
            CHECK(has_ends(ring.rim[k], ring.vertices[k], ring.vertices[(k + 1) % ring.valence()]));
        }
    }
    for (int t = 0; t < patch.triangle_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            CHECK(
                has_ends(patch.triangle_edges(k, t), patch.triangles((k + 1) % 3, t), patch.triangles((k + 2) % 3, t)));
        }
    }
}

TEST_CASE("border edges run in the direction of their triangle") {
    const test::Single single = test::single_patch(test::grid(3, 0.0, test::flat));
    const Patch& patch = single.patch();
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[static_cast<std::size_t>(e)][1] != none) continue;
        const auto [a, b] = patch.edge_ends[static_cast<std::size_t>(e)];
        const Vector3 edge = single.points.col(b) - single.points.col(a);
        const Vector3 middle = 0.5 * (single.points.col(a) + single.points.col(b)) - Vector3(0.5, 0.5, 0.0);
        CHECK(edge.cross(Vector3::UnitZ()).dot(middle) > 0.0);  // e × n points out
    }
}
