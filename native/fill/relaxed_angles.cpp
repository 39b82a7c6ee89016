// How bad the triangles of some vertices are, and moves and flips among them.

#include <Eigen/Geometry>

#include "base/progress.h"
#include "fill/angles.h"
#include "fill/equal_edge_mesh.h"
#include "fill/limits.h"

namespace fairing {

namespace {

constexpr double no_gain = 0.999;  // of the penalty before, for a move or a flip

// Squared, or to the fourth power, where the smallest angle is to count alone.
double powered_lack(double angle, bool worst_counts) {
    const double lack = std::max(0.0, wanted_angle - angle);
    return worst_counts ? lack * lack * lack * lack : lack * lack;
}

double cosine_at(const Vector3& corner, const Vector3& a, const Vector3& b) {
    const Vector3 u = a - corner;
    const Vector3 v = b - corner;
    const double squares = u.squaredNorm() * v.squaredNorm();
    return squares > 0.0 ? u.dot(v) / std::sqrt(squares) : 1.0;
}

}  // namespace

double EqualEdgeMesh::Side::free_angle(const Vector3& place) const {
    double sharpest = -1.0;
    if (!forced[0]) sharpest = std::max(sharpest, cosine_at(place, b, c));
    if (!forced[1]) sharpest = std::max(sharpest, cosine_at(b, c, place));
    if (!forced[2]) sharpest = std::max(sharpest, cosine_at(c, place, b));
    const double angle = std::acos(std::clamp(sharpest, -1.0, 1.0)) * 180.0 / std::numbers::pi;
    return (b - place).cross(c - place).dot(normal) > 0.0 ? angle : -angle;
}

EqualEdgeMesh::Side EqualEdgeMesh::side_of(Halfedge h) const {
    const std::array around{h, mesh_.next_halfedge_handle(h), mesh_.prev_halfedge_handle(h)};
    Side side;
    side.normal.setZero();
    const auto is_free = [&](Halfedge each) { return !fixed(mesh_.from_vertex_handle(each)); };
    const bool any_free = std::ranges::any_of(around, is_free);  // they count alone: edges that stay have two sides
    for (std::size_t k = 0; k < 3; ++k) {
        const Vertex corner = mesh_.from_vertex_handle(around[k]);
        if (!any_free || is_free(around[k])) side.normal += surface_->normal(where_[corner.idx()]);
        side.forced[k] = stays(mesh_.edge_handle(around[k])) && stays(mesh_.edge_handle(around[(k + 2) % 3]));
    }
    side.b = point(mesh_.to_vertex_handle(h));
    side.c = point(apex(h));
    return side;
}

double EqualEdgeMesh::free_angle(Face f) const {
    const Halfedge h = mesh_.halfedge_handle(f);
    return side_of(h).free_angle(point(mesh_.from_vertex_handle(h)));
}

// How bad the triangles at these vertices are.
double EqualEdgeMesh::penalty(const Indices& vertices) const {
    double sum = 0.0;
    for (const int v : vertices) {
        if (mesh_.status(Vertex(v)).deleted()) continue;
        for (const Face f : mesh_.vf_range(Vertex(v))) {
            int inside = 0;
            for (const Halfedge h : sides(f))
                inside += std::binary_search(vertices.begin(), vertices.end(), mesh_.to_vertex_handle(h).idx()) ? 1 : 0;
            sum += powered_lack(free_angle(f), worst_counts_) / inside;  // each triangle once
        }
    }
    return sum;
}

// The triangles around a free vertex.
std::vector<EqualEdgeMesh::Side> EqualEdgeMesh::star(Vertex v) const {
    std::vector<Side> result;
    for (const Halfedge spoke : mesh_.voh_range(v)) result.push_back(side_of(spoke));
    return result;
}

// A pattern search in six directions of the surface. Returns the number of moves.
int EqualEdgeMesh::relax_place(Vertex v) {
    constexpr int most_halvings = 6;  // of half the wanted edge: to a 64th of it
    const std::vector<Side> around = star(v);
    const auto penalty_at = [&](const Vector3& place) {
        double sum = 0.0;
        for (const Side& side : around) sum += powered_lack(side.free_angle(place), worst_counts_);
        return sum;
    };
    double best = penalty_at(point(v));
    int moves = 0;
    for (int halvings = 0; halvings < most_halvings && best > 0.0; ++halvings) {
        const double step = std::ldexp(0.5 * wanted_[v.idx()], -halvings);
        const Vector3 normal = surface_->normal(where_[v.idx()]);
        const Vector3 along = normal.unitOrthogonal();
        const Vector3 across = normal.cross(along);
        for (int j = 0; j < 6; ++j) {
            const double turn = j * std::numbers::pi / 3.0;
            const Vector3 goal = point(v) + step * (std::cos(turn) * along + std::sin(turn) * across);
            const int triangle = where_[v.idx()].triangle;
            const double reached = penalty_at(surface_->position(surface_->project(goal, triangle)));
            if (reached >= no_gain * best) continue;
            best = reached;
            put(v, goal, triangle);
            ++moves;
            break;
        }
    }
    return moves;
}

// Where the least angle beside the edge grows.
bool EqualEdgeMesh::improve_flip(Edge e) {
    const auto [a, b, c, d] = diagonal(e);
    const double before = powered_lack(std::min(least_angle(a, b, c), least_angle(b, a, d)), worst_counts_);
    const double after = powered_lack(std::min(least_angle(c, d, b), least_angle(d, c, a)), worst_counts_);
    if (after >= no_gain * before || !may_flip(e)) return false;
    mesh_.flip(e);
    return true;
}

// Flips the edges from v to vertices of higher number that lie among these. Returns how many.
int EqualEdgeMesh::relax_edges(Vertex v, const Indices& vertices) {
    const auto is_inside = [&](Vertex u) { return std::binary_search(vertices.begin(), vertices.end(), u.idx()); };
    std::vector<Halfedge> spokes;
    for (const Halfedge h : mesh_.voh_range(v)) spokes.push_back(h);
    int flips = 0;
    for (const Halfedge h : spokes) {
        const Edge e = mesh_.edge_handle(h);
        const Vertex end = mesh_.to_vertex_handle(h);
        if (end.idx() < v.idx() || stays(e)) continue;
        if (!is_inside(end) || !is_inside(apex(h)) || !is_inside(apex(mesh_.opposite_halfedge_handle(h)))) continue;
        flips += improve_flip(e) ? 1 : 0;
    }
    return flips;
}

// Flips and moves among these vertices alone.
void EqualEdgeMesh::relax(const Indices& vertices) {
    for (int round = 0; round < most_rounds; ++round) {
        checkpoint();
        int changes = 0;
        for (const int k : vertices) {
            if (!mesh_.status(Vertex(k)).deleted()) changes += relax_edges(Vertex(k), vertices);
        }
        for (const int k : vertices) {
            if (!mesh_.status(Vertex(k)).deleted() && !fixed(Vertex(k))) changes += relax_place(Vertex(k));
        }
        if (changes == 0) return;
    }
}

// The corners of triangles with small angles and their neighbours, ascending.
Indices EqualEdgeMesh::around_small_angles() const {
    Indices found;
    for (const Face f : mesh_.faces()) {
        if (free_angle(f) >= wanted_angle) continue;
        for (const Vertex v : mesh_.fv_range(f)) {
            found.push_back(v.idx());
            for (const Vertex u : mesh_.vv_range(v)) found.push_back(u.idx());
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

// Flips and moves against small angles.
void EqualEdgeMesh::improve() {
    for (int round = 0; round < most_rounds; ++round) {
        const Indices vertices = around_small_angles();
        if (vertices.empty()) return;
        relax(vertices);
    }
}

}  // namespace fairing
