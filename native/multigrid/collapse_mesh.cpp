#include "multigrid/collapse_mesh.h"

#include "base/parallel.h"
#include "base/progress.h"

namespace fairing {

namespace {

constexpr int hub = 12;             // vertices of more neighbours stay
constexpr int smallest_loop = 8;    // vertices that a loop keeps
constexpr double dearest = 12.0;    // a collapse that spoils the valences more than this waits
constexpr double far_share = 0.77;  // keeps the mean energy of a linear function on a regular star

// Domains of a pass: at most so many, of so many vertices at least.
constexpr int most_domains = 16;
constexpr int least_domain = 2048;

}  // namespace

void Removals::append(const Removals& more) {
    for (std::size_t k = 1; k < more.pass_begin.size(); ++k) pass_begin.push_back(size() + more.pass_begin[k]);
    const int offset = begin.back();
    vertex.insert(vertex.end(), more.vertex.begin(), more.vertex.end());
    neighbours.insert(neighbours.end(), more.neighbours.begin(), more.neighbours.end());
    weights.insert(weights.end(), more.weights.begin(), more.weights.end());
    for (std::size_t k = 1; k < more.begin.size(); ++k) begin.push_back(offset + more.begin[k]);
}

CollapseMesh::CollapseMesh(const Patch& patch, const InnerWeights& weights, const FixedPlaces& boundary)
    : boundary_(boundary),
      patch_free_count_(patch.free_count),
      free_count_(patch.free_count),
      pin_(patch.pin),
      border_(patch.vertex_count(), 0),
      dead_vertex_(patch.vertex_count(), 0),
      dead_triangle_(patch.triangle_count(), 0),
      blocked_(patch.vertex_count(), 0),
      valence_(patch.vertex_count(), 0),
      first_side_(patch.vertex_count(), none),
      loop_(patch.vertex_count(), none),
      alive_(patch.vertex_count()) {
    std::iota(alive_.begin(), alive_.end(), 0);
    build_sides(patch);
    set_weights(patch, weights);
    number_loops(patch);
}

void CollapseMesh::build_sides(const Patch& patch) {
    sides_.resize(3 * patch.triangle_count());
    const auto side_along = [&](int edge, int triangle) {
        int corner = 0;  // opposite
        while (patch.triangle_edges(corner, triangle) != edge) ++corner;
        return 3 * triangle + (corner + 1) % 3;
    };
    for_ranges(patch.triangle_count(), coarse_grain, [&](int begin, int end) {
        for (int s = 3 * begin; s < 3 * end; ++s) {
            const int edge = patch.triangle_edges((s + 2) % 3, s / 3);
            const auto [left, right] = patch.edge_triangles[edge];
            const int other = left == s / 3 ? right : left;
            sides_[s] = {side_tail(patch.triangles, s), other == none ? none : side_along(edge, other), 0.0F};
        }
    });
    for_ranges(patch.vertex_count(), coarse_grain, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) {
            const RingView ring = patch.ring(v);
            valence_[v] = static_cast<int>(ring.valence());
            border_[v] = !ring.closed();
            // The ring of a border vertex begins at the side without a twin.
            const int spoke = ring.spokes.front();
            for (const int triangle : patch.edge_triangles[spoke]) {
                if (triangle == none) continue;
                const int side = side_along(spoke, triangle);
                if (sides_[side].corner == v) first_side_[v] = side;
            }
        }
    });
}

void CollapseMesh::set_weights(const Patch& patch, const InnerWeights& weights) {
    VectorX of_edge = VectorX::Zero(patch.edge_count());
    const auto find = [&](int i, int j) {
        const RingView ring = patch.ring(i);
        const auto found = std::find(ring.vertices.begin(), ring.vertices.end(), j);
        return found == ring.vertices.end() ? none
                                            : ring.spokes[static_cast<std::size_t>(found - ring.vertices.begin())];
    };
    double sum = 0.0;
    std::size_t next = 0;  // weights mostly come in the order of the edges
    for (const auto& [i, j, weight] : weights) {
        checkpoint(i);
        const bool in_order = next < patch.edge_ends.size() && patch.edge_ends[next] == std::array{i, j};
        const int edge = in_order ? static_cast<int>(next) : find(i, j);
        ++next;
        sum += weight;
        if (edge != none) of_edge[edge] += weight;
    }
    // A star without any weight (all of its edges are others than the mesh's) is still interpolated from its ring.
    const double least = 1e-3 * sum / std::max<double>(1.0, static_cast<double>(patch.edge_count()));
    for_ranges(static_cast<int>(sides_.size()), coarse_grain, [&](int begin, int end) {
        for (int s = begin; s < end; ++s) {
            const double weight = of_edge[patch.triangle_edges((s + 2) % 3, s / 3)];
            sides_[s].weight = static_cast<float>(std::max(weight, least));
        }
    });
}

void CollapseMesh::number_loops(const Patch& patch) {
    for (const Indices& loop : patch.loops()) {
        for (const int v : loop) loop_[v] = static_cast<int>(loop_size_.size());
        loop_size_.push_back(static_cast<int>(loop.size()));
    }
}

void CollapseMesh::begin_level() {
    least_loop_size_.clear();
    for (const int size : loop_size_) least_loop_size_.push_back(std::max(smallest_loop, (size + 1) / 2));
}

void CollapseMesh::gather(int v, Star& star) const {
    star.centre = v;
    star.vertices.clear();
    star.sides.clear();
    star.weights.clear();
    star.closed = true;
    int s = first_side_[v];
    do {
        star.vertices.push_back(sides_[next_side(s)].corner);
        star.sides.push_back(s);
        star.weights.push_back(sides_[s].weight);
        const int last = previous_side(s);
        s = sides_[last].twin;
        if (s == none) {
            star.closed = false;
            star.vertices.push_back(sides_[last].corner);
            star.sides.push_back(none);
            star.weights.push_back(sides_[last].weight);
            return;
        }
    } while (s != first_side_[v]);
}

// Vertices begin … end − 1. A collapse changes nothing but the star of its centre and what its triangles tell each
// other across the rim: those of stars inside of different domains know nothing of each other.
struct CollapseMesh::Domain {
    std::span<const int> alive;
    Removals removals;
    Indices waiting;  // of those alive: their stars reach beyond, or they are fixed

    [[nodiscard]] bool has(const Star& star) const {
        const auto [least, most] = std::minmax_element(star.vertices.begin(), star.vertices.end());
        return *least >= alive.front() && *most <= alive.back();
    }
};

bool CollapseMesh::may_go(int v) const {
    if (blocked_[v] || valence_[v] > hub) return false;
    return !is_fixed(v) || (!pin_[v] && border_[v]);
}

void CollapseMesh::pass_over(Domain& domain) {
    Star star;
    for (const int v : domain.alive) {
        checkpoint(v);
        if (!may_go(v)) continue;
        gather(v, star);
        if (is_fixed(v) || !domain.has(star)) {
            domain.waiting.push_back(v);
        } else {
            try_collapse(star, domain.removals);
        }
    }
}

// Domains first, then what lies between them. The domains are the same for any number of threads.
Removals CollapseMesh::pass() {
    const int count = static_cast<int>(alive_.size());
    const int pieces = std::clamp(count / least_domain, 1, most_domains);
    std::vector<Domain> domains(pieces);
    for (int k = 0; k < pieces; ++k) {
        const auto begin = std::size_t(count) * std::size_t(k) / std::size_t(pieces);
        const auto end = std::size_t(count) * std::size_t(k + 1) / std::size_t(pieces);
        domains[k].alive = std::span(alive_).subspan(begin, end - begin);
    }
    for (const int v : alive_) blocked_[v] = 0;
    run_pieces(pieces, [&](int k) { pass_over(domains[k]); });
    Removals removals = std::move(domains.front().removals);
    for (std::size_t k = 1; k < domains.size(); ++k) removals.append(std::exchange(domains[k].removals, {}));
    Star star;
    for (const Domain& domain : domains) {
        for (const int v : domain.waiting) {
            checkpoint(v);
            if (blocked_[v]) continue;
            gather(v, star);
            try_collapse(star, removals);
        }
    }
    free_count_ -= removals.size();
    removals.pass_begin.push_back(removals.size());
    std::erase_if(alive_, [&](int v) { return dead_vertex_[v] != 0; });
    return removals;
}

// The first of the cheapest neighbours onto which the centre may go; their number where there is none.
std::size_t CollapseMesh::cheapest_legal(Star& star) const {
    const double largest = *std::max_element(star.weights.begin(), star.weights.end());
    star.prices.clear();
    for (std::size_t k = 0; k < star.size(); ++k) star.prices.push_back(cost(star, k, largest));
    for (;;) {
        const auto cheapest = std::min_element(star.prices.begin(), star.prices.end());
        if (!(*cheapest < dearest)) return star.size();
        const auto k = static_cast<std::size_t>(cheapest - star.prices.begin());
        if (is_legal(star, k)) return k;
        *cheapest = dearest;
    }
}

bool CollapseMesh::try_collapse(Star& star, Removals& removals) {
    const int v = star.centre;
    const std::size_t best = cheapest_legal(star);
    if (best == star.size()) return false;
    if (is_fixed(v)) {
        --loop_size_[loop_[v]];
        pass_fixed_weights_on(star, best);
    } else {
        const double sum = star.weight();
        removals.vertex.push_back(v);
        for (std::size_t k = 0; k < star.size(); ++k) {
            removals.neighbours.push_back(star.vertices[k]);
            removals.weights.push_back(static_cast<float>(star.weights[k] / sum));
        }
        removals.begin.push_back(static_cast<int>(removals.neighbours.size()));
        pass_weights_on(star, best);
    }
    collapse(star, best);
    for (const int u : star.vertices) blocked_[u] = 1;
    return true;
}

// Eliminating the centre of a star leaves springs λ_a λ_b / Σλ between its neighbours (star-mesh transform). Those
// between two that share no edge afterwards go by way of the vertex kept.
void CollapseMesh::pass_weights_on(Star& star, std::size_t k) const {
    const std::size_t n = star.size();
    const double sum = star.weight();
    star.passed.assign(n, 0.0);
    for (std::size_t j = 0; j < n; ++j) {
        if (j == k) continue;
        double far = sum - star.weights[k] - star.weights[j];
        if (star.after(j) != k) far -= star.weights[star.after(j)];
        if (star.before(j) != k) far -= star.weights[star.before(j)];
        star.passed[j] = star.weights[j] * (star.weights[k] + far_share * std::max(far, 0.0)) / sum;
    }
}

void CollapseMesh::pass_fixed_weights_on(Star& star, std::size_t k) const {
    star.passed = star.weights;
    star.passed[k] = 0.0;
}

void CollapseMesh::set_first_side(int v, int side) {
    if (border_[v]) {
        // Clockwise to the end of the fan.
        while (sides_[side].twin != none) side = next_side(sides_[side].twin);
    }
    first_side_[v] = side;
}

// Drops the triangle of `side`, an edge between the star's centre and the vertex kept, and joins what lies behind the
// two other edges, which become one of the given weight.
void CollapseMesh::drop_triangle(int side, double weight) {
    const int a = sides_[next_side(side)].twin;
    const int b = sides_[previous_side(side)].twin;
    dead_triangle_[side / 3] = 1;
    for (const auto& [s, other] : {std::pair(a, b), std::pair(b, a)}) {
        if (s == none) continue;
        sides_[s].twin = other;
        sides_[s].weight = static_cast<float>(weight);
    }
}

void CollapseMesh::strengthen_rim(const Star& star, std::size_t k) {
    const double sum = star.weight();
    for (std::size_t j = 0; j < star.size(); ++j) {
        if (!star.has_triangle(j) || j == k || star.after(j) == k) continue;
        const auto more = static_cast<float>(star.weights[j] * star.weights[star.after(j)] / sum);
        const int rim = next_side(star.sides[j]);
        sides_[rim].weight += more;
        if (sides_[rim].twin != none) sides_[sides_[rim].twin].weight += more;
    }
}

void CollapseMesh::hand_over_spokes(const Star& star, int kept) {
    for (std::size_t j = 0; j < star.size(); ++j) {
        const auto weight = static_cast<float>(star.passed[j]);
        const int s = star.sides[j];
        if (s == none) {
            sides_[previous_side(star.sides[j - 1])].weight = weight;
            continue;
        }
        sides_[s].corner = kept;
        sides_[s].weight = weight;
        if (sides_[s].twin != none) sides_[sides_[s].twin].weight = weight;
    }
}

void CollapseMesh::collapse(const Star& star, std::size_t k) {
    const int kept = star.vertices[k];
    if (!is_fixed(star.centre)) strengthen_rim(star, k);
    hand_over_spokes(star, kept);
    dead_vertex_[star.centre] = 1;
    valence_[kept] += static_cast<int>(star.size()) - (star.closed ? 4 : 3);
    std::array<std::pair<int, std::size_t>, 2> dropped{{{none, 0}, {none, 0}}};  // side, apex
    if (star.has_triangle(k)) {
        const int side = star.sides[k];  // centre → kept → l → centre
        dropped[0] = {side, star.after(k)};
        drop_triangle(side, sides_[next_side(side)].weight + star.passed[star.after(k)]);
    }
    if (star.has_triangle(star.before(k))) {
        const int side = previous_side(star.sides[star.before(k)]);  // kept → centre → r → kept
        dropped[1] = {side, star.before(k)};
        drop_triangle(side, sides_[previous_side(side)].weight + star.passed[star.before(k)]);
    }
    for (const auto& [side, j] : dropped) {
        if (side == none) continue;
        const int apex = star.vertices[j];
        --valence_[apex];
        const int from_apex = sides_[next_side(side)].twin;
        const int to_apex = sides_[previous_side(side)].twin;
        set_first_side(apex, from_apex != none ? from_apex : next_side(to_apex));
        set_first_side(kept, to_apex != none ? to_apex : next_side(from_apex));
    }
}

CoarseMesh CollapseMesh::mesh() const {
    CoarseMesh result;
    PatchMembers& members = result.members;
    Twins& twins = result.twins;
    members.free_count = free_count_;
    Indices local(dead_vertex_.size(), none);
    for (std::size_t v = 0; v < dead_vertex_.size(); ++v) {
        if (dead_vertex_[v]) continue;
        local[v] = static_cast<int>(members.to_input.size());
        members.to_input.push_back(static_cast<int>(v));
        members.pin.push_back(pin_[v]);
    }
    Indices place(dead_triangle_.size(), none);
    for (std::size_t t = 0; t < dead_triangle_.size(); ++t) {
        if (dead_triangle_[t]) continue;
        place[t] = static_cast<int>(members.input_triangle.size());
        members.input_triangle.push_back(static_cast<int>(t));
    }
    twins.reserve(3 * members.input_triangle.size());
    members.triangles.resize(3, static_cast<Eigen::Index>(members.input_triangle.size()));
    for (std::size_t t = 0; t < members.input_triangle.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int side = 3 * members.input_triangle[t] + k;
            const int twin = sides_[side].twin;
            members.triangles(k, static_cast<Eigen::Index>(t)) = local[sides_[side].corner];
            twins.push_back(twin == none ? none : 3 * place[twin / 3] + twin % 3);
        }
    }
    return result;
}

InnerWeights CollapseMesh::weights() const {
    InnerWeights result;
    for (int s = 0; s < static_cast<int>(sides_.size()); ++s) {
        if (dead_triangle_[s / 3] || (sides_[s].twin != none && sides_[s].twin < s)) continue;
        result.push_back({sides_[s].corner, sides_[next_side(s)].corner, sides_[s].weight});
    }
    result.shrink_to_fit();
    return result;
}

}  // namespace fairing
