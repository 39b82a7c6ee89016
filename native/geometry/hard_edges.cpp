#include "geometry/hard_edges.h"

#include "base/columns.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "geometry/dihedral_bands.h"
#include "geometry/flips.h"
#include "mesh/twins.h"
#include "mesh/union_find.h"

namespace fairing {

namespace {

// Degrees by which each edge may bend on a mesh that is meant to be round. A regular pentagon turns by 72° at a corner
// and is a coarse circle, a box turns by 90°.
constexpr double roundest_bend = 40.0;
// Bends to the other side come from noise. The middle half ends at .67 of its standard deviation: this is twice that.
constexpr double noise_margin = 3.0;
constexpr double most_alike = 0.85;  // quantile; one edge in a row of seven, with diagonals, has .09 of the weight
constexpr double runs_on = 0.25;     // cosine of the turn at which a chain goes on: as far as a pentagon's
// A crease that runs between two rows: three rows bend as much as a hard edge, and those beyond do not.
constexpr double rows = 3.0;
constexpr double own_share = 0.35;  // of their bend; above a third: of three equal bends none is an edge
constexpr int chain_length = 4;     // edges: noise has shorter ones
constexpr int corner_edges = 2;     // other hard edges at a corner where a chain ends; between plane faces one

enum Hardness : char { soft, fading, hard };

class HardEdges {
public:
    HardEdges(const Points& points, const Triangles& triangles)
        : points_(points),
          bands_(points, triangles),
          between_planes_(edges().size(), 0),
          hardness_(edges().size(), soft),
          begin_(static_cast<std::size_t>(points.cols()) + 1, 0),
          at_border_(static_cast<std::size_t>(points.cols()), 0) {}

    VertexPairs found(const VertexPairs& marked) {
        measure();
        std::vector<char> is_marked = places_of(marked);
        list_at_vertices(is_marked);
        std::vector<char> kept = in_chains(is_marked);
        VertexPairs result;
        for (int e = 0; e < edges().size(); ++e) {
            if (kept[e] || is_marked[e]) result.push_back(edges().ends[e]);
        }
        return result;
    }

private:
    [[nodiscard]] const EdgeTable& edges() const { return bands_.edges(); }

    void measure() {
        for_ranges(edges().size(), coarse_grain, [&](int begin, int end) {
            for (int e = begin; e < end; ++e) between_planes_[e] = bands_.is_between_planes(e) ? 1 : 0;
        });
        for_ranges(edges().size(), coarse_grain, [&](int begin, int end) {
            DihedralBands::Walk walk;  // made where it is needed: most pieces of a smooth mesh have no such edge
            for (int e = begin; e < end; ++e) {
                if (!(std::abs(bands_.angle(e)) >= own_share * hard_bend)) continue;
                checkpoint(e);
                if (walk.vertices.empty()) walk = bands_.walk();
                hardness_[e] = hardness(e, walk);
            }
        });
    }

    [[nodiscard]] Hardness hardness(int edge, DihedralBands::Walk& walk) const {
        const double bend = std::abs(bands_.angle(edge));
        const double over_rows = std::abs(bands_.angle_over_rows(edge));
        const bool may_be_chamfer = over_rows >= hard_bend && bend >= own_share * over_rows;
        if (bend < fading_bend && !may_be_chamfer) return soft;
        const Usual most = usual(edge, most_alike, walk);
        const double excess = bend - std::max(most.bend, most.noise);
        if (excess >= hard_bend || stands_out(edge, most.noise, walk)) return hard;
        return excess >= fading_bend ? fading : soft;
    }

    // The larger of the bend allowed without hard edges and three times the bend to the other side.
    struct Usual {
        double bend;
        double noise;
    };

    [[nodiscard]] Usual usual(int edge, double share, DihedralBands::Walk& walk) const {
        const AngleRange range = bands_.usual_across(edge, share, between_planes_, walk);
        const bool is_convex = bands_.angle(edge) > 0.0;
        return {std::min(is_convex ? range.high : -range.low, roundest_bend),
                noise_margin * (is_convex ? -range.low : range.high)};
    }

    // Whether the bend is this edge's alone, or it has the greatest part of a bend over three rows, while the mesh
    // beyond is flat. A single edge needs that on one side only, as two may be parallel; three rows may be a fillet's.
    [[nodiscard]] bool stands_out(int edge, double noise, DihedralBands::Walk& walk) const {
        const double bend = std::abs(bands_.angle(edge));
        const double over_rows = std::abs(bands_.angle_over_rows(edge));
        const bool in_chamfer = bend >= own_share * over_rows && over_rows - rows * noise >= hard_bend;
        if (!in_chamfer && bend - noise < hard_bend) return false;
        const auto beyond = bands_.curvatures_beyond(edge, walk);
        if (!beyond) return false;
        const double height = bands_.mean_height(edge);
        if (in_chamfer && over_rows - rows * height * beyond->mean >= hard_bend) return true;
        const double smooth = std::max(noise, height * beyond->least);
        return bend - std::max(smooth, usual(edge, DihedralBands::half, walk).bend) >= hard_bend;
    }

    [[nodiscard]] std::vector<char> places_of(const VertexPairs& pairs) const {
        std::vector<char> result(edges().size(), 0);
        for (const auto& [a, b] : pairs) {
            const std::array wanted{std::min(a, b), std::max(a, b)};
            const auto place = std::lower_bound(edges().ends.begin(), edges().ends.end(), wanted);
            if (place != edges().ends.end() && *place == wanted)
                result[static_cast<std::size_t>(place - edges().ends.begin())] = 1;
        }
        return result;
    }

    // The edges that may be hard at each vertex, and which vertices lie at the border.
    void list_at_vertices(const std::vector<char>& is_marked) {
        const auto counts = [&](int e) { return hardness_[e] != soft || is_marked[e]; };
        for (int e = 0; e < edges().size(); ++e) {
            for (int v : edges().ends[e]) {
                if (edges().side_count(e) != 2) at_border_[v] = 1;
                if (counts(e)) ++begin_[v + 1];
            }
        }
        for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
        at_vertex_.resize(static_cast<std::size_t>(begin_.back()));
        Indices cursor(begin_.begin(), begin_.end() - 1);
        for (int e = 0; e < edges().size(); ++e) {
            if (!counts(e)) continue;
            for (int v : edges().ends[e]) at_vertex_[cursor[v]++] = e;
        }
    }

    [[nodiscard]] bool continues(int edge, int other, int vertex) const {
        if (hardness_[other] == soft || (bands_.angle(edge) > 0.0) != (bands_.angle(other) > 0.0)) return false;
        return way_from(edge, vertex).dot(way_from(other, vertex)) <= -runs_on;
    }

    [[nodiscard]] Vector3 way_from(int edge, int vertex) const {
        const auto [a, b] = edges().ends[edge];
        return direction(points_.col(vertex == a ? b : a) - points_.col(vertex));
    }

    // Whether a chain that ends here counts however short it is.
    [[nodiscard]] bool is_end(int edge, int vertex, UnionFind& chains, const std::vector<char>& is_marked) const {
        if (at_border_[vertex]) return true;
        int others = 0;
        for (int k = begin_[vertex]; k < begin_[vertex + 1]; ++k) {
            const int other = at_vertex_[k];
            if (other == edge) continue;
            if (is_marked[other] || chains.root(other) == chains.root(edge)) return true;
            others += hardness_[other] == hard ? 1 : 0;
        }
        return others >= (between_planes_[edge] ? 1 : corner_edges);
    }

    std::vector<char> in_chains(const std::vector<char>& is_marked) {
        UnionFind chains = joined();
        std::vector<char> has_hard(edges().size(), 0);
        std::vector<char> has_loose_end(edges().size(), 0);
        Indices count(edges().size(), 0);
        for (int e = 0; e < edges().size(); ++e) {
            if (hardness_[e] == soft) continue;
            const int chain = chains.root(e);
            ++count[chain];
            if (hardness_[e] == hard) has_hard[chain] = 1;
            for (int v : edges().ends[e]) {
                if (!is_end(e, v, chains, is_marked)) has_loose_end[chain] = 1;
            }
        }
        std::vector<char> kept(edges().size(), 0);
        for (int e = 0; e < edges().size(); ++e) {
            const int chain = chains.root(e);
            kept[e] = has_hard[chain] && (count[chain] >= chain_length || !has_loose_end[chain]) ? 1 : 0;
        }
        return kept;
    }

    [[nodiscard]] UnionFind joined() const {
        UnionFind chains(edges().size());
        for (int v = 0; v + 1 < static_cast<int>(begin_.size()); ++v) {
            for (int i = begin_[v]; i < begin_[v + 1]; ++i) {
                if (hardness_[at_vertex_[i]] == soft) continue;
                for (int j = i + 1; j < begin_[v + 1]; ++j) {
                    if (continues(at_vertex_[i], at_vertex_[j], v)) chains.join(at_vertex_[i], at_vertex_[j]);
                }
            }
        }
        return chains;
    }

    const Points& points_;
    DihedralBands bands_;
    std::vector<char> between_planes_;
    std::vector<Hardness> hardness_;
    Indices begin_;  // of each vertex in `at_vertex_`
    Indices at_vertex_;
    std::vector<char> at_border_;
};

}  // namespace

// Caps are flipped first: triangles without area have no normal. Both halves of a marked side that is split are marked.
VertexPairs hard_edges(const Points& points, const Triangles& triangles, const VertexPairs& marked) {
    Triangles whole = without_collapsed(triangles);
    const std::vector<char> all(static_cast<std::size_t>(whole.cols()), 1);
    VertexPairs named = marked;
    VertexPairs parted;
    for (const TurnedCap& turned : turn_caps(points, all, all, 0.0, whole)) {
        const auto [a, b] = turned.ends;
        const std::array side{std::min(a, b), std::max(a, b)};
        const bool is_named = std::any_of(named.begin(), named.end(), [&](const std::array<int, 2>& pair) {
            return pair == side || pair == std::array{side[1], side[0]};
        });
        if (!is_named) continue;
        named.push_back({a, turned.over});
        named.push_back({turned.over, b});
        parted.push_back(side);
    }
    VertexPairs found = HardEdges(points, whole).found(named);
    if (parted.empty()) return found;
    found.insert(found.end(), parted.begin(), parted.end());
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace fairing
