// Small angles that moving and flipping can't mend: a vertex more or less there may.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "base/progress.h"
#include "fill/angles.h"
#include "fill/even_mesh.h"

namespace fairing {

namespace {

constexpr double wanted_angle = 30.0;  // degrees; promised are 25
constexpr double bad_angle = 26.0;
constexpr double of_turned = -30.0;           // counts as the angle of a triangle that is turned over
constexpr double worth_it = 0.9;              // of the penalty before
constexpr std::size_t most_attempts = 60;     // triangles
constexpr std::size_t most_copied = 600'000;  // vertices in all attempts; each copies the mesh some ten times
constexpr unsigned most_valence = 8;

}  // namespace

std::array<EvenMesh::Halfedge, 3> EvenMesh::sides(Face f) const {
    const Halfedge h = mesh_.halfedge_handle(f);
    const Halfedge next = mesh_.next_halfedge_handle(h);
    return {h, next, mesh_.next_halfedge_handle(next)};
}

// The least angle of a triangle that is not between two edges that stay: these force it.
double EvenMesh::free_angle(Face f) const {
    const auto around = sides(f);
    double least = 180.0;
    Vector3 normal = Vector3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        const Vertex corner = mesh_.from_vertex_handle(around[k]);
        normal += surface_.normal(where_[at(corner.idx())]);
        if (stays(mesh_.edge_handle(around[k])) && stays(mesh_.edge_handle(around[(k + 2) % 3]))) continue;
        least =
            std::min(least, angle_at(point(corner), point(mesh_.to_vertex_handle(around[k])), point(apex(around[k]))));
    }
    const Vector3 p = point(mesh_.from_vertex_handle(around[0]));
    const Vector3 q = point(mesh_.from_vertex_handle(around[1]));
    const Vector3 r = point(mesh_.from_vertex_handle(around[2]));
    return (q - p).cross(r - p).dot(normal) > 0.0 ? least : of_turned;
}

// The vertices within two edges of a triangle, ascending.
Indices EvenMesh::region(Face f) const {
    Indices found;
    for (const Halfedge h : sides(f)) found.push_back(mesh_.to_vertex_handle(h).idx());
    for (int ring = 0; ring < 2; ++ring) {
        const Indices inner = found;
        for (const int v : inner)
            for (const Vertex u : mesh_.vv_range(Vertex(v))) found.push_back(u.idx());
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
    }
    return found;
}

// How bad the triangles at these vertices are.
double EvenMesh::penalty(const Indices& vertices) const {
    double sum = 0.0;
    for (const int v : vertices) {
        if (mesh_.status(Vertex(v)).deleted()) continue;
        for (const Face f : mesh_.vf_range(Vertex(v))) {
            int inside = 0;
            for (const Halfedge h : sides(f))
                inside += std::binary_search(vertices.begin(), vertices.end(), mesh_.to_vertex_handle(h).idx()) ? 1 : 0;
            const double lack = std::max(0.0, wanted_angle - free_angle(f));
            sum += lack * lack / inside;  // each triangle once
        }
    }
    return sum;
}

// Flips and moves among these vertices alone.
void EvenMesh::settle(const Indices& vertices) {
    constexpr int most_rounds = 4;
    const auto is_inside = [&](Vertex v) { return std::binary_search(vertices.begin(), vertices.end(), v.idx()); };
    for (int round = 0; round < most_rounds; ++round) {
        int changes = 0;
        std::vector<int> movable;
        for (const int k : vertices) {
            const Vertex v(k);
            if (mesh_.status(v).deleted()) continue;
            std::vector<Halfedge> spokes;
            for (const Halfedge h : mesh_.voh_range(v)) spokes.push_back(h);
            for (const Halfedge h : spokes) {
                const Edge e = mesh_.edge_handle(h);
                if (mesh_.to_vertex_handle(h).idx() < k || stays(e)) continue;
                const Halfedge back = mesh_.opposite_halfedge_handle(h);
                if (!is_inside(mesh_.to_vertex_handle(h)) || !is_inside(apex(h)) || !is_inside(apex(back))) continue;
                changes += improve_flip(e) ? 1 : 0;
            }
            if (fixed(v)) continue;
            for (const Face f : mesh_.vf_range(v)) {
                if (free_angle(f) >= wanted_angle) continue;
                movable.push_back(k);
                break;
            }
        }
        changes += improve_places(movable);
        if (changes == 0) return;
    }
}

// Whether an edge halves a sharp corner between two edges that stay, which could be one triangle.
bool EvenMesh::halves_sharp_corner(Edge e) const {
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    if (stays(e) || !mesh_.is_flip_ok(e) || !diagonal(e).flips_without_fold()) return false;
    for (const Halfedge side : {h, mesh_.opposite_halfedge_handle(h)}) {
        const Halfedge back = mesh_.opposite_halfedge_handle(side);
        const Vertex corner = mesh_.from_vertex_handle(side);
        if (mesh_.valence(corner) != 3 || !stays(mesh_.edge_handle(mesh_.prev_halfedge_handle(side)))) continue;
        if (!stays(mesh_.edge_handle(mesh_.next_halfedge_handle(back)))) continue;
        if (angle_at(point(corner), point(apex(side)), point(apex(back))) < sharp_corner) return true;
    }
    return false;
}

// What may be done about a triangle: each returns the vertex that is new, or none.
std::vector<std::function<int(EvenMesh&)>> EvenMesh::remedies(Face f) {
    std::vector<std::function<int(EvenMesh&)>> result;
    for (const Halfedge side : sides(f)) {
        const Edge e = mesh_.edge_handle(side);
        const Halfedge back = mesh_.opposite_halfedge_handle(side);
        if (!stays(e) && mesh_.valence(apex(side)) <= most_valence && mesh_.valence(apex(back)) <= most_valence)
            result.emplace_back([e](EvenMesh& mesh) { return mesh.split(e).idx(); });
        if (halves_sharp_corner(e)) {
            result.emplace_back([e](EvenMesh& mesh) {
                mesh.mesh_.flip(e);
                return none;
            });
        }
        const Vertex corner = mesh_.from_vertex_handle(side);
        if (fixed(corner) || free_count_ < 2) continue;
        for (const Halfedge h : mesh_.voh_range(corner)) {
            if (!may_collapse(h)) continue;
            result.emplace_back([h](EvenMesh& mesh) {
                mesh.mesh_.collapse(h);
                --mesh.free_count_;
                return none;
            });
        }
    }
    return result;
}

bool EvenMesh::mend(Face f) {
    const Indices vertices = region(f);
    double least = worth_it * penalty(vertices);
    std::optional<EvenMesh> best;
    for (const auto& remedy : remedies(f)) {
        checkpoint();
        EvenMesh tried(*this);
        Indices known = vertices;
        const int added = remedy(tried);
        if (added != none) known.push_back(added);  // the highest number
        tried.settle(known);
        const double after = tried.penalty(known);
        if (after >= least) continue;
        least = after;
        best.emplace(std::move(tried));
    }
    if (!best) return false;
    mesh_ = std::move(best->mesh_);
    fixed_ = std::move(best->fixed_);
    kept_ = std::move(best->kept_);
    where_ = std::move(best->where_);
    wanted_ = std::move(best->wanted_);
    free_count_ = best->free_count_;
    return true;
}

void EvenMesh::mend_angles() {
    constexpr int most_rounds = 3;
    const std::size_t most = std::min(most_attempts, most_copied / mesh_.n_vertices() + 1);
    std::size_t attempts = 0;
    for (int round = 0; round < most_rounds; ++round) {
        std::vector<std::pair<double, int>> bad;
        for (const Face f : mesh_.faces()) {
            const double angle = free_angle(f);
            if (angle < bad_angle) bad.emplace_back(angle, f.idx());
        }
        std::sort(bad.begin(), bad.end());
        int mended = 0;
        for (const auto& [angle, index] : bad) {
            const Face f(index);
            if (mesh_.status(f).deleted() || free_angle(f) >= bad_angle) continue;
            if (++attempts > most) return;
            mended += mend(f) ? 1 : 0;
        }
        if (mended == 0) return;
    }
}

}  // namespace fairing
