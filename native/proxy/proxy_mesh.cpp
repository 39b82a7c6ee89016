#include "proxy/proxy_mesh.h"

#include <Eigen/Geometry>

#include "base/progress.h"
#include "geometry/face_geometry.h"
#include "geometry/flips.h"
#include "geometry/limits.h"
#include "geometry/triangle.h"
#include "geometry/vertex_normal.h"
#include "mesh/nearest_first.h"

namespace fairing {

namespace {

constexpr unsigned highest_valence = 9;  // that a collapse may leave
constexpr double cos_of_turned = 0.2;    // normals of a triangle before and after a collapse
constexpr double collapse_below = 0.7;   // of the local length

struct QueuedEdge {
    double length;
    int halfedge;
    bool operator>(const QueuedEdge& other) const {
        return length != other.length ? length > other.length : halfedge > other.halfedge;
    }
};

// The shortest halfedge first, each at its latest length alone. An entry that waits already is no second one: a
// collapse changes few of the lengths around it.
class ShortestFirst {
public:
    explicit ShortestFirst(std::size_t halfedges) : waiting_(halfedges, nowhere) {}

    // Before `begin`, in any order.
    void add(const QueuedEdge& edge) {
        waiting_[static_cast<std::size_t>(edge.halfedge)] = edge.length;
        heap_.push_back(edge);
    }
    void begin() { std::make_heap(heap_.begin(), heap_.end(), std::greater<>()); }

    void push(const QueuedEdge& edge) {
        if (waiting_[static_cast<std::size_t>(edge.halfedge)] == edge.length) return;
        add(edge);
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
    void drop(int halfedge) { waiting_[static_cast<std::size_t>(halfedge)] = nowhere; }

    [[nodiscard]] bool is_empty() const { return heap_.empty(); }

    // `none` where the halfedge has another length by now.
    [[nodiscard]] int top() const {
        const QueuedEdge& edge = heap_.front();
        return waiting_[static_cast<std::size_t>(edge.halfedge)] == edge.length ? edge.halfedge : none;
    }

    void pop() {
        if (const int halfedge = top(); halfedge != none) drop(halfedge);
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
        heap_.pop_back();
    }

private:
    static constexpr double nowhere = std::numeric_limits<double>::infinity();  // no halfedge is so long
    std::vector<QueuedEdge> heap_;
    std::vector<double> waiting_;  // the length of a halfedge's entry
};

}  // namespace

ProxyMesh::ProxyMesh(const Patch& patch, const Points& points)
    : mesh_(surface_mesh(patch)), fixed_(patch.vertex_count(), 1), pin_(patch.pin), free_count_(patch.free_count) {
    std::fill(fixed_.begin(), fixed_.begin() + patch.free_count, 0);
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    mesh_.request_halfedge_status();
    for (int v = 0; v < patch.vertex_count(); ++v) mesh_.set_point(mesh_.vertex_handle(unsigned(v)), points.col(v));
}

bool ProxyMesh::should_flip(Edge e) const {
    if (mesh_.is_boundary(e)) return false;
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    const Halfedge g = mesh_.halfedge_handle(e, 1);
    const Vertex above = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
    const Vertex below = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(g));
    if (fixed(above) && fixed(below)) return false;
    const Diagonal diagonal{point(mesh_.from_vertex_handle(h)), point(mesh_.to_vertex_handle(h)), point(above),
                            point(below)};
    return !diagonal.is_delaunay() && mesh_.is_flip_ok(e) && diagonal.flips_without_fold();
}

int ProxyMesh::flip_round() {
    int flips = 0;
    for (const Edge e : mesh_.edges()) {
        checkpoint(e.idx());
        if (!should_flip(e)) continue;
        mesh_.flip(e);
        ++flips;
    }
    return flips;
}

Vector3 ProxyMesh::normal(Vertex v) const {
    std::vector<Vector3> ring;
    for (const Vertex neighbour : mesh_.vv_ccw_range(v)) ring.push_back(point(neighbour));
    return max_normal({point(v), ring, !mesh_.is_boundary(v)});
}

void ProxyMesh::smooth() {
    std::vector<Vector3> moved(mesh_.n_vertices());
    std::vector<Vector3> ring;
    for (const Vertex v : mesh_.vertices()) {
        checkpoint(v.idx());
        if (fixed(v)) continue;
        ring.clear();
        for (const Vertex neighbour : mesh_.vv_ccw_range(v)) ring.push_back(point(neighbour));
        const OneRing one_ring{point(v), ring, true};
        const Vector3 normal = max_normal(one_ring);
        Vector3 mean = Vector3::Zero();
        for (const Vector3& p : ring) mean += p;
        const Vector3 pull = mean / static_cast<double>(ring.size()) - one_ring.centre;
        moved[v.idx()] = one_ring.centre + 0.5 * (pull - pull.dot(normal) * normal);
    }
    for (const Vertex v : mesh_.vertices()) {
        if (!fixed(v)) mesh_.set_point(v, moved[v.idx()]);
    }
}

void ProxyMesh::remesh(int rounds, int sweeps) {
    for (int k = 0; k < rounds && flip_round() > 0; ++k) continue;
    for (int k = 0; k < sweeps; ++k) smooth();
}

// Whether the vertex at the start of h may move into its end.
bool ProxyMesh::may_collapse(Halfedge h) {
    const Vertex gone = mesh_.from_vertex_handle(h);
    const Vertex kept = mesh_.to_vertex_handle(h);
    if (fixed(gone) || !mesh_.is_collapse_ok(h)) return false;
    if (mesh_.valence(gone) + mesh_.valence(kept) > highest_valence + 4) return false;
    // Two fixed vertices must not become neighbours across the patch.
    for (const Vertex other : mesh_.vv_range(gone)) {
        if (!fixed(kept)) break;
        if (other != kept && fixed(other) && !mesh_.find_halfedge(kept, other).is_valid()) return false;
    }
    return true;
}

// Whether a collapse leaves no poor triangle, unless one was worse before.
bool ProxyMesh::keeps_shape(Halfedge h) const {
    const Vertex gone = mesh_.from_vertex_handle(h);
    const Vertex kept = mesh_.to_vertex_handle(h);
    double before = 1.0;
    double after = 1.0;
    for (const Halfedge spoke : mesh_.voh_range(gone)) {
        const Vertex b = mesh_.to_vertex_handle(spoke);
        const Vertex c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(spoke));
        before = std::min(before, triangle_shape(point(gone), point(b), point(c)));
        if (b == kept || c == kept) continue;
        after = std::min(after, triangle_shape(point(kept), point(b), point(c)));
        const Vector3 old_normal = area_vector(point(gone), point(b), point(c));
        const Vector3 new_normal = area_vector(point(kept), point(b), point(c));
        if (old_normal.dot(new_normal) < cos_of_turned * old_normal.norm() * new_normal.norm()) return false;
    }
    return after >= poor_shape || after >= before;
}

double ProxyMesh::relative_length(Halfedge h, const VectorX& target) const {
    const double wanted = 0.5 * (target[mesh_.from_vertex_handle(h).idx()] + target[mesh_.to_vertex_handle(h).idx()]);
    return mesh_.calc_edge_length(h) / wanted;
}

// Whether an edge would have to be split again.
bool ProxyMesh::makes_long(Halfedge h, const VectorX& target) const {
    const Vertex kept = mesh_.to_vertex_handle(h);
    for (const Vertex other : mesh_.vv_range(mesh_.from_vertex_handle(h))) {
        if (other == kept) continue;
        const double wanted = 0.5 * (target[kept.idx()] + target[other.idx()]);
        if ((point(other) - point(kept)).norm() > split_above * wanted) return true;
    }
    return false;
}

void ProxyMesh::collapse(Halfedge h) {
    RemovedVertex entry{mesh_.from_vertex_handle(h).idx(), {}};
    entry.ring.reserve(mesh_.valence(mesh_.from_vertex_handle(h)));
    for (const Vertex other : mesh_.vv_range(mesh_.from_vertex_handle(h))) entry.ring.push_back(other.idx());
    removed_.push_back(std::move(entry));
    mesh_.collapse(h);
    --free_count_;
}

// Shortest first.
int ProxyMesh::collapse_short(const VectorX& target, const Care& care) {
    ShortestFirst queue(mesh_.n_halfedges());
    const auto is_short = [&](Halfedge h, double length) {
        return !fixed(mesh_.from_vertex_handle(h)) && length < collapse_below;
    };
    for (const Halfedge h : mesh_.halfedges()) {
        const double length = relative_length(h, target);
        if (is_short(h, length)) queue.add({length, h.idx()});
    }
    queue.begin();
    const auto renew = [&](Halfedge h, double length) {
        is_short(h, length) ? queue.push({length, h.idx()}) : queue.drop(h.idx());
    };
    int collapses = 0;
    // An edge beside a collapse that is shorter than what collapsed rests: it goes in its place.
    for (; !queue.is_empty() && free_count_ > 1; queue.pop()) {
        checkpoint();
        const Halfedge h(queue.top());
        if (!h.is_valid() || mesh_.status(h).deleted() || !may_collapse(h)) continue;
        if ((care.for_shapes && !keeps_shape(h)) || (care.for_lengths && makes_long(h, target))) continue;
        const Vertex kept = mesh_.to_vertex_handle(h);
        collapse(h);
        ++collapses;
        for (const Halfedge spoke : mesh_.voh_range(kept)) {
            const double length = relative_length(spoke, target);
            renew(spoke, length);
            renew(mesh_.opposite_halfedge_handle(spoke), length);
        }
    }
    return collapses;
}

// The longest edges at each vertex that `turn` admits.
VectorX ProxyMesh::lengths_by_turn(const Sizing& sizing) const {
    VectorX target = VectorX::Constant(static_cast<Eigen::Index>(mesh_.n_vertices()), sizing.longest);
    if (!std::isfinite(sizing.turn)) return target;
    std::vector<Vector3> normals(mesh_.n_vertices(), Vector3::Zero());
    for (const Vertex v : mesh_.vertices()) {
        if (!fixed(v)) normals[v.idx()] = normal(v);
    }
    for (const Edge e : mesh_.edges()) {
        const Vertex a = mesh_.to_vertex_handle(mesh_.halfedge_handle(e, 0));
        const Vertex b = mesh_.to_vertex_handle(mesh_.halfedge_handle(e, 1));
        if (fixed(a) || fixed(b)) continue;
        const Vector3& n = normals[a.idx()];
        const Vector3& m = normals[b.idx()];
        const double angle = radians_between(n, m);
        const double admitted = sizing.turn * mesh_.calc_edge_length(e) / std::max(angle, 1e-6);
        for (const Vertex v : {a, b}) target[v.idx()] = std::min(target[v.idx()], admitted);
    }
    for (double& length : target) length = std::max(length, 0.25 * sizing.longest);
    return target;
}

VectorX ProxyMesh::target_lengths(const Sizing& sizing) const {
    const VectorX by_turn = lengths_by_turn(sizing);
    NearestFirst target(VectorX::Constant(by_turn.size(), sizing.longest));
    for (const Vertex v : mesh_.vertices()) target.lower(v.idx(), by_turn[v.idx()]);
    for (const Edge e : mesh_.edges()) {
        if (!mesh_.is_boundary(e)) continue;
        for (const int side : {0, 1})
            target.lower(mesh_.to_vertex_handle(mesh_.halfedge_handle(e, side)).idx(), mesh_.calc_edge_length(e));
    }
    for (int v = target.next(); v != none; v = target.next()) {
        for (const Halfedge h : mesh_.voh_range(mesh_.vertex_handle(unsigned(v))))
            target.lower(mesh_.to_vertex_handle(h).idx(), target[v] + sizing.growth * mesh_.calc_edge_length(h));
    }
    return std::move(target).take();
}

// Longest first.
int ProxyMesh::split_long(const VectorX& target, int free_limit) {
    std::vector<std::pair<double, int>> long_edges;
    for (const Edge e : mesh_.edges()) {
        const double length = relative_length(mesh_.halfedge_handle(e, 0), target);
        if (!mesh_.is_boundary(e) && length > split_above) long_edges.emplace_back(-length, e.idx());
    }
    std::sort(long_edges.begin(), long_edges.end());
    int splits = 0;
    for (const auto& [length, index] : long_edges) {
        if (free_count_ >= free_limit) break;
        checkpoint();
        const Edge e(index);
        const Vertex middle = mesh_.add_vertex(mesh_.calc_edge_midpoint(e));
        mesh_.split(e, middle);
        fixed_.push_back(0);
        pin_.push_back(0);
        ++free_count_;
        ++splits;
    }
    return splits;
}

void ProxyMesh::adapt(const Sizing& sizing) {
    constexpr int most_rounds = 12;      // a bound: rounds end when they change little
    constexpr int shapeless_rounds = 2;  // a crumpled start has no shapes worth keeping
    const int vertices_per_change = sizing.converges ? 50 : 100;
    for (int round = 0; round < most_rounds; ++round) {
        const VectorX target = target_lengths(sizing);
        const bool is_crumpled = round < shapeless_rounds;
        const bool is_careful = !is_crumpled || removed_.empty();
        int changes = collapse_short(target, {is_careful, is_careful && sizing.converges});
        if (is_crumpled) changes += collapse_short(target, {});
        changes += split_long(target_lengths(sizing), sizing.free_limit);
        remesh(5, 3);
        if (changes <= free_count_ / vertices_per_change) break;
    }
    if (sizing.converges) remesh(5, 3);
}

ProxyMesh::Snapshot ProxyMesh::snapshot() const {
    PatchMembers members;
    members.free_count = free_count_;
    Indices local(mesh_.n_vertices(), none);
    for (const bool wanted_fixed : {false, true}) {
        for (const Vertex v : mesh_.vertices()) {
            if (fixed(v) != wanted_fixed) continue;
            local[v.idx()] = static_cast<int>(members.to_input.size());
            members.to_input.push_back(v.idx());
            members.pin.push_back(pin_[v.idx()]);
        }
    }
    for (const SurfaceMesh::FaceHandle f : mesh_.faces()) members.input_triangle.push_back(f.idx());
    members.triangles = triangles_of(mesh_, local);
    Points points(3, static_cast<Eigen::Index>(members.to_input.size()));
    for (Eigen::Index v = 0; v < points.cols(); ++v) {
        points.col(v) = mesh_.point(mesh_.vertex_handle(unsigned(members.to_input[static_cast<std::size_t>(v)])));
    }
    return {Patch(std::move(members)), std::move(points)};
}

void ProxyMesh::read_back(const Patch& patch, const Points& points) {
    for (Eigen::Index v = 0; v < points.cols(); ++v) {
        mesh_.set_point(mesh_.vertex_handle(unsigned(patch.to_input[static_cast<int>(v)])), points.col(v));
    }
}

}  // namespace fairing
