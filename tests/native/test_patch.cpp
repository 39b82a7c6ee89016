#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "mesh/renumbered.h"
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

namespace {

// Each triangle as the old numbers of its corners, counter-clockwise, the lowest first.
std::multiset<std::array<int, 3>> triangles_of(const SurfaceMesh& mesh, const Indices& old_numbers) {
    std::multiset<std::array<int, 3>> found;
    for (const auto f : mesh.faces()) {
        std::array<int, 3> corners{};
        std::size_t k = 0;
        for (const auto v : mesh.fv_ccw_range(f)) corners[k++] = old_numbers[v.idx()];
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        found.insert(corners);
    }
    return found;
}

Indices numbers_below(std::size_t count) {
    Indices numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

}  // namespace

TEST_CASE("a half-edge mesh that is numbered anew is the same mesh, also where parts of it are deleted") {
    const test::Single single = test::single_patch(test::grid(6, 0.2, test::flat));
    SurfaceMesh mesh = surface_mesh(single.patch());
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_halfedge_status();
    mesh.request_face_status();
    for (const auto v : mesh.vertices()) mesh.set_point(v, single.points.col(v.idx()));
    const auto gone = mesh.halfedge_handle(mesh.vertex_handle(0));
    REQUIRE(mesh.is_collapse_ok(gone));
    mesh.collapse(gone);
    Indices vertices = numbers_below(mesh.n_vertices());
    Indices edges;
    for (const auto e : mesh.edges()) edges.push_back(e.idx());
    std::mt19937 random(1);
    std::shuffle(vertices.begin(), vertices.end(), random);
    std::shuffle(edges.begin(), edges.end(), random);
    SurfaceMesh other = renumbered(mesh, vertices, edges);
    CHECK(other.n_edges() + 3 == mesh.n_edges());
    CHECK(triangles_of(other, vertices) == triangles_of(mesh, numbers_below(mesh.n_vertices())));
    for (const auto v : other.all_vertices()) {
        const SurfaceMesh::VertexHandle old(vertices[v.idx()]);
        CHECK(other.status(v).deleted() == mesh.status(old).deleted());
        CHECK(other.point(v) == mesh.point(old));
        if (other.status(v).deleted()) continue;
        CHECK(other.is_boundary(v) == mesh.is_boundary(old));
        CHECK(other.valence(v) == mesh.valence(old));
    }
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const auto h = mesh.halfedge_handle(SurfaceMesh::EdgeHandle(edges[k]), 0);
        const auto g = other.halfedge_handle(SurfaceMesh::EdgeHandle(static_cast<int>(k)), 0);
        CHECK(vertices[other.to_vertex_handle(g).idx()] == mesh.to_vertex_handle(h).idx());
    }
}
