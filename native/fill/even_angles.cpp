// The last triangles with small angles.
#include <array>
#include <cmath>
#include <numbers>

#include "base/progress.h"
#include "fill/angles.h"
#include "fill/even_mesh.h"

namespace fairing {

namespace {

constexpr double wanted_angle = 30.0;    // degrees; promised are 25
constexpr double wanted_cosine = 0.866;  // of a little more
constexpr double gain = 0.1;
constexpr int most_rounds = 12;

}  // namespace

// Of the star around v if v were there; negative where a triangle turns away from the surface.
double EvenMesh::worst_angle_around(Vertex v, const Vector3& position) const {
    const Vector3 normal = surface_->normal(where_[v.idx()]);
    double worst = 180.0;
    for (const Halfedge spoke : mesh_.voh_range(v)) {
        if (mesh_.is_boundary(spoke)) continue;
        const Vector3 b = point(mesh_.to_vertex_handle(spoke));
        const Vector3 c = point(apex(spoke));
        if (!((b - position).cross(c - position).dot(normal) > 0.0)) return -1.0;
        worst = std::min(worst, least_angle(position, b, c));
    }
    return worst;
}

bool EvenMesh::improve_flip(Edge e) {
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    const Vector3 a = point(mesh_.from_vertex_handle(h));
    const Vector3 b = point(mesh_.to_vertex_handle(h));
    const Vector3 c = point(apex(h));
    const Vector3 d = point(apex(mesh_.halfedge_handle(e, 1)));
    if (!may_be_sharper(a, b, c, wanted_cosine) && !may_be_sharper(b, a, d, wanted_cosine)) return false;
    const double before = std::min(least_angle(a, b, c), least_angle(b, a, d));
    if (before >= wanted_angle) return false;
    const double after = std::min(least_angle(c, d, b), least_angle(d, c, a));
    if (after <= before + gain || !may_flip(e)) return false;
    mesh_.flip(e);
    return true;
}

int EvenMesh::improve_flips() {
    int flips = 0;
    for (const Edge e : mesh_.edges()) {
        if (!stays(e) && improve_flip(e)) ++flips;
    }
    return flips;
}

// A pattern search for each vertex, in six directions of the surface, from a quarter of its length downwards.
int EvenMesh::improve_places(const std::vector<int>& vertices) {
    constexpr int most_halvings = 5;
    int moves = 0;
    for (const int k : vertices) {
        checkpoint();
        const Vertex v(k);
        double best = worst_angle_around(v, point(v));
        for (int halvings = 0; halvings < most_halvings; ++halvings) {
            const double step = std::ldexp(0.25 * wanted_[k], -halvings);
            const Vector3 normal = surface_->normal(where_[k]);
            const Vector3 along = normal.unitOrthogonal();
            const Vector3 across = normal.cross(along);
            for (int j = 0; j < 6; ++j) {
                const double turn = j * std::numbers::pi / 3.0;
                const Vector3 goal = point(v) + step * (std::cos(turn) * along + std::sin(turn) * across);
                const SurfacePoint where = surface_->project(goal, where_[k].triangle);
                const double worst = worst_angle_around(v, surface_->position(where));
                if (worst <= best + gain) continue;
                best = worst;
                put(v, goal, where_[k].triangle);
                ++moves;
                break;
            }
        }
    }
    return moves;
}

void EvenMesh::improve() {
    for (int round = 0; round < most_rounds; ++round) {
        std::vector<int> vertices;
        std::vector<char> listed(mesh_.n_vertices(), 0);
        for (const SurfaceMesh::FaceHandle f : mesh_.faces()) {
            std::array<Vertex, 3> corners;
            std::size_t k = 0;
            for (const Vertex v : mesh_.fv_range(f)) corners[k++] = v;
            const auto [a, b, c] = std::array{point(corners[0]), point(corners[1]), point(corners[2])};
            if (!may_be_sharper(a, b, c, wanted_cosine) || least_angle(a, b, c) >= wanted_angle) continue;
            for (const Vertex v : corners) {
                if (fixed(v) || listed[v.idx()] != 0) continue;
                listed[v.idx()] = 1;
                vertices.push_back(v.idx());
            }
        }
        if (improve_flips() + improve_places(vertices) == 0) return;
    }
}

}  // namespace fairing
