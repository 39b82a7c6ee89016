#include "fill/equal_edge_mesh.h"

#include <queue>

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "base/progress.h"
#include "fill/angles.h"
#include "fill/limits.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double collapse_below = 0.75;    // of the wanted length
constexpr double longest_after = 1.4;      // edges that a collapse makes
constexpr double most_per_expected = 2.0;  // vertices; on a surface with folds splits would never end

using QueuedEdge = std::pair<double, int>;  // relative length, half-edge
using ShortestFirst = std::priority_queue<QueuedEdge, std::vector<QueuedEdge>, std::greater<>>;

}  // namespace

EqualEdgeMesh::EqualEdgeMesh(const Patch& patch, const Points& points, const TargetSurface& surface,
                             const VectorX& lengths, KeptEdges kept, EdgeSet taken)
    : patch_(&patch),
      points_(&points),
      surface_(&surface),
      lengths_(&lengths),
      mesh_(surface_mesh(patch)),
      kept_(std::move(kept)),
      taken_(std::move(taken)),
      free_count_(patch.free_count) {
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    mesh_.request_halfedge_status();
    for (int v = 0; v < patch.vertex_count(); ++v) {
        mesh_.set_point(mesh_.vertex_handle(unsigned(v)), points.col(v));
        fixed_.push_back(patch.is_free(v) ? 0 : 1);
        where_.push_back(surface.at_vertex(v));
        wanted_.push_back(lengths[v]);
    }
    kept_.resize(mesh_.n_edges(), 0);
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (kept_[e] == 0) continue;
        for (const int v : patch.edge_ends[e]) fixed_[v] = 1;
    }
}

// Length of the edge wanted between two vertices. Where lengths grow steadily from one to the other, their logarithmic
// mean counts: by the mean of a long and a short one, the edge of a coarse boundary's corner would never be split.
double EqualEdgeMesh::wanted_between(Vertex one, Vertex other) const {
    const auto [low, high] = std::minmax(wanted_[one.idx()], wanted_[other.idx()]);
    const double more = high - low;
    return more > 0.0 ? more / std::log1p(more / low) : low;
}

double EqualEdgeMesh::relative_length(Edge e) const {
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    return mesh_.calc_edge_length(e) / wanted_between(mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h));
}

bool EqualEdgeMesh::is_chord(Edge e) const {
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    return !stays(e) && fixed(mesh_.from_vertex_handle(h)) && fixed(mesh_.to_vertex_handle(h));
}

// A corner that is sharper stays one triangle: halved, its angle would be too small. Not where its third side is an
// edge outside, of a face that sticks out into the boundary: there the triangle would lie on that face.
bool EqualEdgeMesh::is_sharp_corner(Vertex corner, Vertex a, Vertex b) const {
    const auto [low, high] = std::minmax({a.idx() - patch_->free_count, b.idx() - patch_->free_count});
    return !taken_.contains({low, high}) && angle_at(point(corner), point(a), point(b)) < sharp_corner;
}

bool EqualEdgeMesh::cuts_sharp_corner(Edge e) const {
    for (const unsigned side : {0U, 1U}) {
        const Halfedge h = mesh_.halfedge_handle(e, side);
        const Halfedge next = mesh_.next_halfedge_handle(h);
        const Halfedge last = mesh_.next_halfedge_handle(next);
        if (!stays(mesh_.edge_handle(next)) || !stays(mesh_.edge_handle(last))) continue;
        if (is_sharp_corner(apex(h), mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h))) return true;
    }
    return false;
}

// The place on the surface that a walk from `triangle` finds.
void EqualEdgeMesh::put(Vertex v, const Vector3& position, int triangle) {
    const SurfacePoint where = surface_->project(position, triangle);
    where_[v.idx()] = where;
    mesh_.set_point(v, surface_->position(where));
    wanted_[v.idx()] = surface_->interpolate(*lengths_, where);
}

// A triangle of the surface on this side of all kept edges. Only an edge that was always there, or that a
// collapse left over, has none but fixed vertices around.
int EqualEdgeMesh::triangle_beside(Edge e) const {
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    for (const Vertex v :
         {mesh_.to_vertex_handle(h), mesh_.from_vertex_handle(h), apex(h), apex(mesh_.halfedge_handle(e, 1))}) {
        if (!fixed(v)) return where_[v.idx()].triangle;
    }
    return e.idx() < patch_->edge_count() ? patch_->edge_triangles[e.idx()][0] : where_[apex(h).idx()].triangle;
}

EqualEdgeMesh::Vertex EqualEdgeMesh::split(Edge e) {
    const int beside = triangle_beside(e);
    const Vector3 middle = mesh_.calc_edge_midpoint(e);
    const Vertex v = mesh_.add_vertex(middle);
    mesh_.split(e, v);
    kept_.resize(mesh_.n_edges(), 0);
    ++free_count_;
    fixed_.push_back(0);
    where_.emplace_back();
    wanted_.push_back(0.0);
    put(v, middle, beside);
    return v;
}

int EqualEdgeMesh::split_chords() {
    int splits = 0;
    const auto count = mesh_.n_edges();
    for (unsigned k = 0; k < count; ++k) {
        const Edge e(static_cast<int>(k));
        if (mesh_.status(e).deleted() || !is_chord(e) || cuts_sharp_corner(e)) continue;
        split(e);
        ++splits;
    }
    return splits;
}

// Longest first.
int EqualEdgeMesh::split_long() {
    std::vector<QueuedEdge> long_edges;
    for (const Edge e : mesh_.edges()) {
        if (stays(e)) continue;
        const double length = relative_length(e);
        if (length > split_above && !(is_chord(e) && cuts_sharp_corner(e))) long_edges.emplace_back(-length, e.idx());
    }
    std::sort(long_edges.begin(), long_edges.end());
    for (const auto& [length, index] : long_edges) {
        checkpoint();
        split(Edge(index));
    }
    return static_cast<int>(long_edges.size());
}

// Whether a collapse of h makes edges of more than `most` times the wanted length.
bool EqualEdgeMesh::makes_long_edges(Halfedge h, double most) const {
    const Vertex kept = mesh_.to_vertex_handle(h);
    const Vector3 place = point(kept);
    for (const Vertex other : mesh_.vv_range(mesh_.from_vertex_handle(h))) {
        const double longest = most * wanted_between(other, kept);
        if (other != kept && (place - point(other)).squaredNorm() > longest * longest) return true;
    }
    return false;
}

// Whether the vertex at the start of h may move into its end. What stops most is asked first.
bool EqualEdgeMesh::may_collapse(Halfedge h) {
    const Vertex gone = mesh_.from_vertex_handle(h);
    const Vertex kept = mesh_.to_vertex_handle(h);
    if (fixed(gone) || makes_long_edges(h, longest_after)) return false;
    if (static_cast<int>(mesh_.valence(gone) + mesh_.valence(kept)) - 4 > highest_valence) return false;
    if (!mesh_.is_collapse_ok(h)) return false;
    const Vector3 place = point(kept);
    const Vector3 normal = surface_->normal(where_[gone.idx()]);  // an edge that stays has two sides
    for (const Halfedge spoke : mesh_.voh_range(gone)) {
        const Vertex other = mesh_.to_vertex_handle(spoke);
        const Vertex next = apex(spoke);
        if (other == kept) continue;
        if (fixed(kept) && fixed(other) && !mesh_.find_halfedge(kept, other).is_valid()) return false;
        if (next == kept) continue;
        if (!(area_vector(place, point(other), point(next)).dot(normal) > 0.0)) return false;
    }
    return true;
}

// Shortest first.
int EqualEdgeMesh::collapse_short() {
    ShortestFirst queue;
    const auto push = [&](Edge e) {
        const double length = relative_length(e);
        if (!(length < collapse_below)) return;
        for (const unsigned side : {0U, 1U}) {
            const Halfedge h = mesh_.halfedge_handle(e, side);
            if (!fixed(mesh_.from_vertex_handle(h))) queue.emplace(length, h.idx());
        }
    };
    for (const Edge e : mesh_.edges()) push(e);
    int collapses = 0;
    for (; !queue.empty() && free_count_ > 1; queue.pop()) {
        checkpoint();
        const Halfedge h(queue.top().second);
        if (mesh_.status(h).deleted() || relative_length(mesh_.edge_handle(h)) != queue.top().first) continue;
        if (!may_collapse(h)) continue;
        const Vertex kept = mesh_.to_vertex_handle(h);
        mesh_.collapse(h);
        --free_count_;
        ++collapses;
        for (const Edge spoke : mesh_.ve_range(kept)) push(spoke);
    }
    return collapses;
}

bool EqualEdgeMesh::may_flip(Edge e) const {
    if (stays(e) || !mesh_.is_flip_ok(e)) return false;
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    const Vertex above = apex(h);
    const Vertex below = apex(mesh_.halfedge_handle(e, 1));
    if (fixed(above) && fixed(below)) return false;
    for (const Vertex v : {above, below}) {
        if (static_cast<int>(mesh_.valence(v)) >= highest_valence) return false;
    }
    return diagonal(e).flips_without_fold();
}

Diagonal EqualEdgeMesh::diagonal(Edge e) const {
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    return {point(mesh_.from_vertex_handle(h)), point(mesh_.to_vertex_handle(h)), point(apex(h)),
            point(apex(mesh_.halfedge_handle(e, 1)))};
}

// An edge is looked at again where a flip has changed a triangle beside it, or where it may not flip yet.
int EqualEdgeMesh::flip_edges() {
    std::vector<char> pending(mesh_.n_edges(), 1);
    int flips = 0;
    for (int round = 0; round < most_rounds; ++round) {
        const int before = flips;
        for (const Edge e : mesh_.edges()) {
            checkpoint(e.idx());
            if (pending[e.idx()] == 0) continue;
            if (stays(e) || diagonal(e).is_delaunay()) {
                pending[e.idx()] = 0;
            } else if (may_flip(e)) {
                mesh_.flip(e);
                ++flips;
                for (const Edge side : sides_around(e)) pending[side.idx()] = 1;
            }
        }
        if (flips == before) break;
    }
    return flips;
}

// The outer sides of the two triangles at an edge.
std::array<EqualEdgeMesh::Edge, 4> EqualEdgeMesh::sides_around(Edge e) const {
    std::array<Edge, 4> sides;
    std::size_t count = 0;
    for (const unsigned k : {0U, 1U}) {
        const Halfedge next = mesh_.next_halfedge_handle(mesh_.halfedge_handle(e, k));
        sides[count++] = mesh_.edge_handle(next);
        sides[count++] = mesh_.edge_handle(mesh_.next_halfedge_handle(next));
    }
    return sides;
}

// Each free vertex to the centroid of its star, where large triangles count more: those around come to one size, in
// units of the wanted length.
void EqualEdgeMesh::smooth(int sweeps) {
    const int count = static_cast<int>(mesh_.n_vertices());
    std::vector<SurfacePoint> moved(count);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for_ranges(count, coarse_grain, [&](int begin, int end) {
            for (int k = begin; k < end; ++k) {
                const Vertex v(k);
                if (fixed(v) || mesh_.status(v).deleted()) continue;
                Vector3 sum = Vector3::Zero();
                double total = 0.0;
                for (const Halfedge spoke : mesh_.voh_range(v)) {
                    const Vertex b = mesh_.to_vertex_handle(spoke);
                    const Vertex c = apex(spoke);
                    const double wanted = wanted_[k] + wanted_[b.idx()] + wanted_[c.idx()];
                    const double weight = area_vector(point(v), point(b), point(c)).norm() / (wanted * wanted * wanted);
                    sum += weight / 3.0 * (point(v) + point(b) + point(c));
                    total += weight;
                }
                const SurfacePoint found = total > 0.0 ? surface_->project(sum / total, where_[k].triangle) : where_[k];
                moved[k] = found.weights.minCoeff() > 0.0 ? found : where_[k];  // not onto a border, over its vertices
            }
        });
        for (int k = 0; k < count; ++k) {
            const Vertex v(k);
            if (fixed(v) || mesh_.status(v).deleted()) continue;
            where_[k] = moved[k];
            mesh_.set_point(v, surface_->position(moved[k]));
            wanted_[k] = surface_->interpolate(*lengths_, moved[k]);
        }
    }
}

void EqualEdgeMesh::equalise() {
    constexpr int most_sweeps = 20;  // a bound: sweeps end when they change little
    int calm_rounds = 0;
    const double most = most_per_expected * (expected_count(*patch_, *points_, *lengths_) + patch_->vertex_count());
    split_chords();
    for (int round = 0; round < most_sweeps && calm_rounds < most_rounds; ++round) {
        const int before = static_cast<int>(mesh_.n_vertices());
        if (before > most) break;
        int changes = split_long();
        changes += collapse_short();
        flip_edges();
        changes += split_chords();
        smooth(2);
        flip_edges();
        if (20 * changes <= before) ++calm_rounds;
    }
    smooth(3);
    flip_edges();
    split_chords();
    improve();
}

}  // namespace fairing
