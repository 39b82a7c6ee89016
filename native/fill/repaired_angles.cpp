// Small angles that moving and flipping can't mend: a vertex more or less there may.

#include "base/progress.h"
#include "fill/angles.h"
#include "fill/equal_edge_mesh.h"
#include "fill/limits.h"

namespace fairing {

namespace {

constexpr double worth_it = 0.9;              // of the penalty before
constexpr double coarsest = 2.0;              // of the wanted length: what is left of two edges
constexpr double most_bad = 0.2;              // of all triangles; where there are more, the surface is folded
constexpr std::size_t most_attempts = 60;     // triangles
constexpr std::size_t most_copied = 600'000;  // vertices in all attempts; each copies the mesh some ten times

}  // namespace

std::array<EqualEdgeMesh::Halfedge, 3> EqualEdgeMesh::sides(Face f) const {
    const Halfedge h = mesh_.halfedge_handle(f);
    const Halfedge next = mesh_.next_halfedge_handle(h);
    return {h, next, mesh_.next_halfedge_handle(next)};
}

// The vertices within two edges of a triangle, ascending.
Indices EqualEdgeMesh::region(Face f) const {
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

// Whether an edge between these two would cut off a sharp corner between two edges that stay, a neighbour of both.
bool EqualEdgeMesh::closes_sharp_corner(Vertex a, Vertex b) const {
    for (const Halfedge h : mesh_.voh_range(a)) {
        const Vertex corner = mesh_.to_vertex_handle(h);
        const Halfedge on = mesh_.find_halfedge(corner, b);
        if (!on.is_valid() || !stays(mesh_.edge_handle(h)) || !stays(mesh_.edge_handle(on))) continue;
        if (is_sharp_corner(corner, a, b)) return true;
    }
    return false;
}

bool EqualEdgeMesh::may_join(Vertex a, Vertex b) const { return !fixed(a) || !fixed(b) || closes_sharp_corner(a, b); }

// Whether the ends of h may become one, whatever shape the triangles have then.
bool EqualEdgeMesh::may_close(Halfedge h) {
    const Vertex gone = mesh_.from_vertex_handle(h);
    const Vertex kept = mesh_.to_vertex_handle(h);
    if (fixed(gone) || free_count_ < 2 || !mesh_.is_collapse_ok(h)) return false;
    if (makes_long_edges(h, coarsest)) return false;
    if (static_cast<int>(mesh_.valence(gone) + mesh_.valence(kept)) > highest_valence + 4) return false;
    for (const Vertex other : mesh_.vv_range(gone)) {
        if (other != kept && !mesh_.find_halfedge(kept, other).is_valid() && !may_join(kept, other)) return false;
    }
    return true;
}

// Each free vertex among these to the middle of its neighbours.
void EqualEdgeMesh::centre(std::span<const Vertex> vertices) {
    for (const Vertex v : vertices) {
        if (fixed(v)) continue;
        Vector3 sum = Vector3::Zero();
        for (const Vertex u : mesh_.vv_range(v)) sum += point(u);
        put(v, sum / static_cast<double>(mesh_.valence(v)), where_[v.idx()].triangle);
    }
}

int EqualEdgeMesh::turn_edge(Edge e) {
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    const std::array ends{mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h)};
    mesh_.flip(e);
    centre(ends);
    return none;
}

// What may be done about a triangle: each returns the vertex that is new, or none. Turned edges and collapses may fold
// the mesh: `relax` unfolds it, or the penalty is high.
std::vector<std::function<int(EqualEdgeMesh&)>> EqualEdgeMesh::remedies(Face f) {
    std::vector<std::function<int(EqualEdgeMesh&)>> result;
    for (const Halfedge side : sides(f)) {
        const Edge e = mesh_.edge_handle(side);
        const Vertex corner = mesh_.from_vertex_handle(side);
        if (!stays(e)) {
            const Vertex above = apex(side);
            const Vertex below = apex(mesh_.opposite_halfedge_handle(side));
            const bool has_room =
                static_cast<int>(std::max(mesh_.valence(above), mesh_.valence(below))) <= highest_valence;
            if (has_room) result.emplace_back([e](EqualEdgeMesh& mesh) { return mesh.split(e).idx(); });
            if (has_room && mesh_.is_flip_ok(e) && may_join(above, below))
                result.emplace_back([e](EqualEdgeMesh& mesh) { return mesh.turn_edge(e); });
        }
        if (fixed(corner)) continue;
        for (const Halfedge h : mesh_.voh_range(corner)) {
            if (!may_close(h)) continue;
            result.emplace_back([h](EqualEdgeMesh& mesh) {
                mesh.mesh_.collapse(h);
                --mesh.free_count_;
                return none;
            });
        }
    }
    return result;
}

bool EqualEdgeMesh::repair(Face f) {
    const Indices vertices = region(f);
    double least = worth_it * penalty(vertices);
    std::optional<EqualEdgeMesh> best;
    for (const auto& remedy : remedies(f)) {
        EqualEdgeMesh tried(*this);
        Indices known = vertices;
        const int added = remedy(tried);
        if (added != none) known.push_back(added);  // the highest number
        tried.relax(known);
        const double after = tried.penalty(known);
        if (after >= least) continue;
        least = after;
        best.emplace(std::move(tried));
    }
    if (!best) return false;
    *this = std::move(*best);
    return true;
}

// The worst first.
std::vector<EqualEdgeMesh::Face> EqualEdgeMesh::bad_faces() const {
    std::vector<std::pair<double, int>> bad;
    for (const Face f : mesh_.faces()) {
        const double angle = free_angle(f);
        if (angle < bad_angle) bad.emplace_back(angle, f.idx());
    }
    std::sort(bad.begin(), bad.end());
    std::vector<Face> result;
    result.reserve(bad.size());
    for (const auto& [angle, index] : bad) result.emplace_back(index);
    return result;
}

void EqualEdgeMesh::repair_angles() {
    worst_counts_ = true;
    const std::size_t most = std::min(most_attempts, most_copied / mesh_.n_vertices() + 1);
    std::size_t attempts = 0;
    for (int round = 0; round < most_rounds; ++round) {
        const std::vector<Face> bad = bad_faces();
        if (static_cast<double>(bad.size()) > most_bad * static_cast<double>(mesh_.n_faces())) return;
        int repaired = 0;
        for (const Face f : bad) {
            if (mesh_.status(f).deleted() || free_angle(f) >= bad_angle) continue;
            if (++attempts > most) return;
            repaired += repair(f) ? 1 : 0;
        }
        if (repaired == 0) return;
    }
}

}  // namespace fairing
