#include "fill/quads.h"

#include <Eigen/Geometry>

#include "geometry/triangle.h"
#include "mesh/edges.h"

namespace fairing {

namespace {

constexpr double widest = 165.0 * degree;    // of a quad's angles: short of 180°, from where on it is not convex
constexpr double most_bent = 40.0 * degree;  // between both triangles
constexpr double step = 1e-6;                // costs nearer than that are equal, so that roundoff doesn't choose
constexpr int most_visited = 20'000;         // triangles in the search for one path

struct Candidate {
    int edge;
    double cost;
};

// Around the two triangles with the sides `first` and `second` along one edge.
std::array<int, 4> quad_at(const Triangles& triangles, int first, int second) {
    const auto apex = [&](int side) { return triangles((side % 3 + 2) % 3, side / 3); };
    return {apex(first), side_tail(triangles, first), apex(second), side_head(triangles, first)};
}

// How far the quad is from a flat rectangle, in radians; nothing where it is none to be had.
std::optional<double> cost_of(const Points& points, const std::array<int, 4>& quad) {
    if (quad[0] == quad[2]) return std::nullopt;
    const Vector3 p = points.col(quad[0]);
    const Vector3 a = points.col(quad[1]);
    const Vector3 q = points.col(quad[2]);
    const Vector3 b = points.col(quad[3]);
    // Unfolded at the diagonal a b. Bending shrinks the halves evenly in the plane between them: what is convex
    // unfolded is convex there, too.
    const std::array<double, 4> angles{
        radians_between(a - p, b - p), radians_between(p - a, b - a) + radians_between(q - a, b - a),
        radians_between(b - q, a - q), radians_between(p - b, a - b) + radians_between(q - b, a - b)};
    if (*std::max_element(angles.begin(), angles.end()) > widest) return std::nullopt;
    const double bent = radians_between((a - p).cross(b - p), (b - q).cross(a - q));
    if (!(bent < most_bent)) return std::nullopt;
    double worst = 0.0;
    for (const double each : angles) worst = std::max(worst, std::abs(each - 0.5 * std::numbers::pi));
    return std::round((worst + bent) / step) * step;
}

class Pairing {
public:
    Pairing(const Points& points, const Triangles& triangles, const std::vector<std::array<int, 2>>& kept)
        : triangles_(triangles), edges_(make_edges(triangles, static_cast<int>(points.cols()))) {
        possible_.resize(static_cast<int>(triangles.cols()));
        diagonal_.assign(possible_.size(), none);
        before_.assign(possible_.size(), none);
        for (int e = 0; e < edges_.size(); ++e) {
            if (!std::binary_search(kept.begin(), kept.end(), edges_.ends[e])) collect(points, e);
        }
        std::stable_sort(candidates_.begin(), candidates_.end(),
                         [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
        for (const Candidate& each : candidates_)
            for (int k = 0; k < 2; ++k) possible_[edges_.side(each.edge, k) / 3].push_back(each.edge);
    }

    void pair_the_best() {
        for (const Candidate& each : candidates_)
            if (is_free(edges_.side(each.edge, 0) / 3) && is_free(edges_.side(each.edge, 1) / 3)) join(each.edge);
    }

    // Until no path is found: one may make others possible.
    void pair_more() {
        for (bool again = true; again;) {
            again = false;
            for (int t = 0; t < static_cast<int>(diagonal_.size()); ++t)
                if (is_free(t) && augmented(t)) again = true;
        }
    }

    [[nodiscard]] PairedQuads result() const;

private:
    [[nodiscard]] bool is_free(int t) const { return diagonal_[t] == none; }

    [[nodiscard]] int across(int e, int t) const {
        const int first = edges_.side(e, 0) / 3;
        return first == t ? edges_.side(e, 1) / 3 : first;
    }

    void join(int e) {
        for (int k = 0; k < 2; ++k) diagonal_[edges_.side(e, k) / 3] = e;
    }

    void collect(const Points& points, int e) {
        if (edges_.side_count(e) != 2) return;
        const int first = edges_.side(e, 0);
        const int second = edges_.side(e, 1);
        if (side_tail(triangles_, first) != side_head(triangles_, second)) return;
        const std::optional<double> cost = cost_of(points, quad_at(triangles_, first, second));
        if (cost) candidates_.push_back({e, *cost});
    }

    bool augmented(int root);
    void flip_path(int end);

    const Triangles& triangles_;
    EdgeTable edges_;
    std::vector<Candidate> candidates_;  // cheapest first
    std::vector<Indices> possible_;      // of each triangle: the edges that could be its diagonal, likewise
    Indices diagonal_;                   // of each triangle: the edge across which it is paired
    Indices before_;                     // of triangles in a search: the edge that leads there
};

// Searches paths of edges that are no diagonals and edges that are, in turns, from one free triangle to another.
bool Pairing::augmented(int root) {
    Indices outer{root};
    Indices seen;
    int end = none;
    for (std::size_t k = 0; k < outer.size() && end == none && k < most_visited; ++k) {
        for (const int e : possible_[outer[k]]) {
            const int next = across(e, outer[k]);
            if (next == root || before_[next] != none || diagonal_[next] == e) continue;
            before_[next] = e;
            seen.push_back(next);
            if (is_free(next)) {
                end = next;
                break;
            }
            const int partner = across(diagonal_[next], next);
            before_[partner] = diagonal_[next];
            seen.push_back(partner);
            outer.push_back(partner);
        }
    }
    if (end != none) flip_path(end);
    for (const int t : seen) before_[t] = none;
    return end != none;
}

void Pairing::flip_path(int end) {
    for (int t = end;;) {
        const int e = before_[t];
        const int outer = across(e, t);
        const int old = diagonal_[outer];
        join(e);
        if (old == none) return;
        t = across(old, outer);
    }
}

PairedQuads Pairing::result() const {
    PairedQuads result;
    std::vector<std::array<int, 4>> quads;
    for (int t = 0; t < static_cast<int>(diagonal_.size()); ++t) {
        if (is_free(t)) {
            result.rest.push_back(t);
            continue;
        }
        const int e = diagonal_[t];
        const int first = edges_.side(e, 0);
        const int second = edges_.side(e, 1);
        if (std::min(first, second) / 3 != t) continue;
        result.pairs.push_back({std::min(first, second) / 3, std::max(first, second) / 3});
        quads.push_back(quad_at(triangles_, std::min(first, second), std::max(first, second)));
    }
    result.quads.resize(4, static_cast<Eigen::Index>(quads.size()));
    for (std::size_t k = 0; k < quads.size(); ++k)
        result.quads.col(static_cast<Eigen::Index>(k)) = Eigen::Map<const Eigen::Vector4i>(quads[k].data());
    return result;
}

}  // namespace

PairedQuads paired_quads(const Points& points, const Triangles& triangles,
                         const std::vector<std::array<int, 2>>& kept) {
    std::vector<std::array<int, 2>> sorted = kept;
    for (std::array<int, 2>& ends : sorted) std::sort(ends.begin(), ends.end());
    std::sort(sorted.begin(), sorted.end());
    Pairing pairing(points, triangles, sorted);
    pairing.pair_the_best();
    pairing.pair_more();
    return pairing.result();
}

}  // namespace fairing
