#include "shape/rounded_edges.h"

#include "base/columns.h"
#include "geometry/dihedral_bands.h"
#include "mesh/twins.h"
#include "mesh/union_find.h"
#include "shape/limits.h"

namespace fairing {

namespace {

constexpr double least_straight = 0.85;  // cosine of the turn at which a chain goes on: not around corners

// Its edges before and after.
class Comparison {
public:
    explicit Comparison(const MovedMesh& change)
        : points_(change.before),
          triangles_(without_collapsed(change.triangles)),
          old_(change.before, triangles_),
          new_(change.after, triangles_),
          moves_(static_cast<std::size_t>(change.before.cols()), 0) {
        for (const int v : change.moved) moves_[v] = 1;
    }

    [[nodiscard]] const EdgeTable& edges() const { return old_.edges(); }
    [[nodiscard]] double bend(int edge) const { return std::abs(old_.angle(edge)); }
    [[nodiscard]] Eigen::Index vertex_count() const { return points_.cols(); }

    // Those of the pairs that are edges, in their order.
    [[nodiscard]] Indices places(const VertexPairs& pairs) const {
        Indices found;
        for (const auto& ends : pairs) {
            const auto place = std::lower_bound(edges().ends.begin(), edges().ends.end(), ends);
            if (place != edges().ends.end() && *place == ends) {
                found.push_back(static_cast<int>(place - edges().ends.begin()));
            }
        }
        return found;
    }

    [[nodiscard]] bool is_flatter(int edge) const {
        const auto [a, b] = edges().ends[edge];
        return (moves_[a] || moves_[b]) && bend(edge) - std::abs(new_.angle(edge)) > flatter;
    }

    // With its triangles.
    [[nodiscard]] bool stays(int edge) const {
        for (int k = 0; k < edges().side_count(edge); ++k) {
            const auto corners = triangles_.col(edges().side(edge, k) / 3);
            if (std::any_of(corners.begin(), corners.end(), [&](int v) { return moves_[v]; })) return false;
        }
        return true;
    }

    // Whether one hard edge runs on in another that shares the vertex.
    [[nodiscard]] bool continues(int edge, int other, int vertex) const {
        if ((old_.angle(edge) > 0.0) != (old_.angle(other) > 0.0)) return false;
        return direction_from(edge, vertex).dot(direction_from(other, vertex)) <= -least_straight;
    }

    // For each edge: how much other edges of its triangles than the marked ones bend at most, over its own bend.
    [[nodiscard]] double bend_beside(int edge, const std::vector<char>& is_hard) const {
        double most = 0.0;
        for (int k = 0; k < edges().side_count(edge); ++k) {
            const int t = edges().side(edge, k) / 3;
            for (int side = 3 * t; side < 3 * t + 3; ++side) {
                const int other = edges().edge_of_side[side];
                if (!is_hard[other]) most = std::max(most, bend(other));
            }
        }
        return most / bend(edge);
    }

    [[nodiscard]] Indices moved_ends(const Indices& chosen) const {
        std::vector<char> found(moves_.size(), 0);
        for (const int e : chosen) {
            for (const int v : edges().ends[e]) found[v] = moves_[v];
        }
        Indices ends;
        for (int v = 0; v < static_cast<int>(found.size()); ++v) {
            if (found[v]) ends.push_back(v);
        }
        return ends;
    }

private:
    [[nodiscard]] Vector3 direction_from(int edge, int vertex) const {
        const auto [a, b] = edges().ends[edge];
        return direction(points_.col(vertex == a ? b : a) - points_.col(vertex));
    }

    const Points& points_;
    Triangles triangles_;
    DihedralBands old_;
    DihedralBands new_;
    std::vector<char> moves_;
};

// The hard edges of each chain.
std::vector<Indices> chains_of(const Comparison& surface, const Indices& hard) {
    UnionFind joined(static_cast<int>(hard.size()));
    std::vector<Indices> at_vertex(static_cast<std::size_t>(surface.vertex_count()));
    for (int k = 0; k < static_cast<int>(hard.size()); ++k) {
        for (const int v : surface.edges().ends[hard[k]]) {
            for (const int other : at_vertex[v]) {
                if (surface.continues(hard[k], hard[other], v)) joined.join(k, other);
            }
            at_vertex[v].push_back(k);
        }
    }
    std::vector<Indices> chains(hard.size());
    for (int k = 0; k < static_cast<int>(hard.size()); ++k) chains[joined.root(k)].push_back(hard[k]);
    return chains;
}

// Whether edges stand out so much that they are a line on the surface: fins and folds of skin are round.
bool stand_out(const Comparison& surface, const Indices& edges, const std::vector<char>& is_hard) {
    std::vector<double> beside;
    beside.reserve(edges.size());
    for (const int e : edges) beside.push_back(surface.bend_beside(e, is_hard));
    const auto middle = beside.begin() + static_cast<std::ptrdiff_t>(beside.size() / 2);
    std::nth_element(beside.begin(), middle, beside.end());
    return *middle <= most_beside;
}

}  // namespace

Indices rounded_edges(const MovedMesh& change) {
    const Comparison surface(change);
    const Indices hard = surface.places(hard_edges(change.before, change.triangles, {}));
    std::vector<char> is_hard(static_cast<std::size_t>(surface.edges().size()), 0);
    for (const int e : hard) is_hard[e] = 1;
    Indices found;
    for (const Indices& chain : chains_of(surface, hard)) {
        Indices blunt;
        Indices staying;
        std::copy_if(chain.begin(), chain.end(), std::back_inserter(blunt),
                     [&](int e) { return surface.is_flatter(e); });
        std::copy_if(chain.begin(), chain.end(), std::back_inserter(staying), [&](int e) { return surface.stays(e); });
        if (blunt.empty() || static_cast<int>(staying.size()) < runs_on) continue;
        if (!stand_out(surface, blunt, is_hard) || !stand_out(surface, staying, is_hard)) continue;
        found.insert(found.end(), blunt.begin(), blunt.end());
    }
    return surface.moved_ends(found);
}

Indices rounded_marks(const MovedMesh& change, const VertexPairs& marked) {
    const Comparison surface(change);
    Indices found = surface.places(marked);
    if (static_cast<double>(found.size()) > most_marked * surface.edges().size()) return {};
    std::erase_if(found, [&](int e) { return surface.bend(e) < hard_bend || !surface.is_flatter(e); });
    return surface.moved_ends(found);
}

}  // namespace fairing
