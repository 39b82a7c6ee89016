#include "fairness/inner_weights.h"

#include <cstdint>

#include "base/progress.h"
#include "mesh/edges.h"

namespace fairing {

namespace {

// A triangulation known by its edge lengths alone (Bobenko & Springborn 2007; Fisher et al. 2007). Edges may join a
// vertex to itself, and two vertices may share several edges.
class IntrinsicTriangulation {
public:
    // Precondition: triangles consistently wound, no edge with more than two.
    IntrinsicTriangulation(const Triangles& triangles, const Points& points);

    // Flips until cot α + cot β ≥ 0 at all inner edges; a bound on the number of flips keeps round-off from cycling.
    void make_delaunay();

    // cot α + cot β of each edge; ≥ 0 after make_delaunay up to round-off, clamped to a small positive multiple of
    // the mean, so that a degenerate reference still gives a definite matrix.
    [[nodiscard]] InnerWeights cotangent_weights() const;

private:
    // Side h = 3 t + k of triangle t leads from tail[h] to the tail of the triangle's next side.
    [[nodiscard]] static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
    // Cotangent of the angle opposite to side h.
    [[nodiscard]] double opposite_cotangent(int h) const;
    [[nodiscard]] double cotangent_sum(int h) const;
    bool flip(int h);
    void place_triangle(int t, std::array<int, 3> tails, std::array<double, 3> lengths, std::array<int, 3> twins);

    Indices tail_;
    Indices twin_;
    std::vector<double> length_;
};

// Cotangent of the angle between sides b and c of a triangle with sides a, b, c; finite where it is degenerate.
double cotangent_from_lengths(double a, double b, double c) {
    const double s = 0.5 * (a + b + c);
    const double squared_area = s * (s - a) * (s - b) * (s - c);
    const double longest = std::max({a, b, c});
    const double area = std::sqrt(std::max(squared_area, 1e-24 * std::pow(longest, 4)));
    return (b * b + c * c - a * a) / (4.0 * std::max(area, 1e-300));
}

IntrinsicTriangulation::IntrinsicTriangulation(const Triangles& triangles, const Points& points) {
    const int side_count = 3 * static_cast<int>(triangles.cols());
    tail_.resize(side_count);
    twin_.assign(side_count, none);
    length_.resize(side_count);
    for (int h = 0; h < side_count; ++h) {
        checkpoint(h);
        tail_[h] = side_tail(triangles, h);
        length_[h] = (points.col(side_tail(triangles, h)) - points.col(side_head(triangles, h))).norm();
    }
    const EdgeTable edges = make_edges(triangles, static_cast<int>(points.cols()));
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) != 2) continue;
        twin_[edges.side(e, 0)] = edges.side(e, 1);
        twin_[edges.side(e, 1)] = edges.side(e, 0);
    }
}

double IntrinsicTriangulation::opposite_cotangent(int h) const {
    return cotangent_from_lengths(length_[h], length_[next(h)], length_[next(next(h))]);
}

double IntrinsicTriangulation::cotangent_sum(int h) const {
    const int twin = twin_[h];
    return opposite_cotangent(h) + (twin == none ? 0.0 : opposite_cotangent(twin));
}

void IntrinsicTriangulation::place_triangle(int t, std::array<int, 3> tails, std::array<double, 3> lengths,
                                            std::array<int, 3> twins) {
    for (int k = 0; k < 3; ++k) {
        const int h = 3 * t + k;
        tail_[h] = tails[k];
        length_[h] = lengths[k];
        twin_[h] = twins[k];
        if (twins[k] != none) twin_[twins[k]] = h;
    }
}

// Lays the two triangles at side h out in the plane and replaces their common edge by the other diagonal.
bool IntrinsicTriangulation::flip(int h) {
    const int g = twin_[h];
    const int t = h / 3;
    const int u = g / 3;
    if (t == u) return false;
    const int h1 = next(h);
    const int h2 = next(h1);
    const int g1 = next(g);
    const int g2 = next(g1);
    const std::array outer{h1, h2, g1, g2};
    for (int side : outer) {
        const int twin = twin_[side];
        if (twin != none && (twin / 3 == t || twin / 3 == u)) return false;  // a cone: not flippable by this layout
    }
    const double base = length_[h];
    const auto apex = [base](double from_start, double from_end) {
        const double x = (base * base + from_start * from_start - from_end * from_end) / (2.0 * base);
        return Eigen::Vector2d(x, std::sqrt(std::max(from_start * from_start - x * x, 0.0)));
    };
    const Eigen::Vector2d above = apex(length_[h2], length_[h1]);
    Eigen::Vector2d below = apex(length_[g1], length_[g2]);
    below.y() = -below.y();
    const double diagonal = (above - below).norm();
    if (!(diagonal > 0.0) || !std::isfinite(diagonal)) return false;

    const int start = tail_[h];
    const int end = tail_[g];
    const int top = tail_[h2];
    const int bottom = tail_[g2];
    const std::array outer_length{length_[h1], length_[h2], length_[g1], length_[g2]};
    const std::array outer_twin{twin_[h1], twin_[h2], twin_[g1], twin_[g2]};
    place_triangle(t, {top, start, bottom}, {outer_length[1], outer_length[2], diagonal},
                   {outer_twin[1], outer_twin[2], none});
    place_triangle(u, {bottom, end, top}, {outer_length[3], outer_length[0], diagonal},
                   {outer_twin[3], outer_twin[0], none});
    twin_[3 * t + 2] = 3 * u + 2;
    twin_[3 * u + 2] = 3 * t + 2;
    return true;
}

void IntrinsicTriangulation::make_delaunay() {
    Indices queue;
    for (int h = 0; h < static_cast<int>(tail_.size()); ++h) {
        if (twin_[h] > h) queue.push_back(h);
    }
    const auto most_steps = std::int64_t{20} * static_cast<std::int64_t>(tail_.size());
    for (std::int64_t step = 0; step < most_steps && !queue.empty(); ++step) {
        checkpoint(static_cast<int>(step % 4096));
        const int h = queue.back();
        queue.pop_back();
        if (twin_[h] == none || cotangent_sum(h) >= -1e-10) continue;
        const int t = h / 3;
        const int u = twin_[h] / 3;
        if (!flip(h)) continue;
        for (int k = 0; k < 2; ++k) queue.insert(queue.end(), {3 * t + k, 3 * u + k});
    }
}

InnerWeights IntrinsicTriangulation::cotangent_weights() const {
    InnerWeights weights;
    double sum = 0.0;
    for (int h = 0; h < static_cast<int>(tail_.size()); ++h) {
        checkpoint(h);
        const int twin = twin_[h];
        const int i = tail_[h];
        const int j = tail_[next(h)];
        if ((twin != none && twin < h) || i == j) continue;
        weights.push_back({i, j, cotangent_sum(h)});
        sum += std::abs(weights.back().weight);
    }
    const double floor = 1e-6 * sum / static_cast<double>(std::max<std::size_t>(weights.size(), 1));
    for (WeightedEdge& edge : weights) edge.weight = std::max(edge.weight, floor);
    return weights;
}

}  // namespace

InnerWeights uniform_weights(const std::vector<std::array<int, 2>>& edges) {
    InnerWeights weights;
    weights.reserve(edges.size());
    for (const auto& [i, j] : edges) weights.push_back({i, j, 1.0});
    return weights;
}

InnerWeights uniform_weights(const Patch& patch) { return uniform_weights(patch.edge_ends); }

bool is_uniform(const Lambda& weights) {
    return !weights || std::all_of(weights->begin(), weights->end(),
                                   [&](const WeightedEdge& edge) { return edge.weight == weights->front().weight; });
}

InnerWeights conformal_weights(const Patch& patch, const Points& reference) {
    IntrinsicTriangulation triangulation(patch.triangles, reference);
    triangulation.make_delaunay();
    return triangulation.cotangent_weights();
}

}  // namespace fairing
