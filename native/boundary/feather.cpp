#include "boundary/feather.h"

#include <map>

#include "geometry/neighbourhood.h"
#include "mesh/nearest_first.h"

namespace fairing {

namespace {

using Edge = std::array<int, 2>;

Edge sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<Edge> sorted_edges(const Triangles& triangles) {
    std::vector<Edge> edges;
    for (const auto t : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) edges.push_back(sorted(t[k], t[(k + 1) % 3]));
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

std::vector<Edge> shared_edges(const Triangles& inside, const Triangles& outside) {
    const std::vector<Edge> first = sorted_edges(inside);
    const std::vector<Edge> second = sorted_edges(outside);
    std::vector<Edge> shared;
    std::set_intersection(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(shared));
    return shared;
}

double distance_to(const Vector3& point, const Vector3& a, const Vector3& b) {
    const Vector3 along = b - a;
    const double length = along.squaredNorm();
    const double share = length > 0.0 ? std::clamp((point - a).dot(along) / length, 0.0, 1.0) : 0.0;
    return (point - a - share * along).norm();
}

// A walk from the outline outwards, the nearest first: from vertex to vertex goes the nearest edge, with those next to
// it.
class Walk {
public:
    Walk(const Points& points, const Triangles& outside, std::vector<Edge> edges, const std::vector<char>& stops)
        : points_(points),
          stops_(stops),
          around_(outside, static_cast<int>(points.cols())),
          edges_(std::move(edges)),
          nearest_edge_(static_cast<std::size_t>(points.cols()), none),
          reached_(VectorX::Constant(points.cols(), std::numeric_limits<double>::infinity())) {
        for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
            for (int v : edges_[e]) edges_at_[v].push_back(e);
        }
    }

    VectorX distances(double farthest) && {
        for (const auto& [v, edges] : edges_at_) reach(v, edges.front());
        for (int v = reached_.next(); v != none && !(reached_[v] > farthest); v = reached_.next()) {
            if (stops_[v]) continue;
            const int edge = nearest_edge_[v];
            for (int k = around_.begin[v]; k < around_.begin[v + 1]; ++k) spread(around_.neighbours[k], edge);
        }
        return std::move(reached_).take();
    }

private:
    void spread(int vertex, int edge) {
        for (int end : edges_[edge]) {
            for (int near : edges_at_[end]) reach(vertex, near);
        }
    }

    void reach(int vertex, int edge) {
        const auto [a, b] = edges_[edge];
        if (reached_.lower(vertex, distance_to(points_.col(vertex), points_.col(a), points_.col(b))))
            nearest_edge_[vertex] = edge;
    }

    const Points& points_;
    const std::vector<char>& stops_;
    VertexAdjacency around_;
    std::vector<Edge> edges_;
    std::map<int, Indices> edges_at_;
    Indices nearest_edge_;
    NearestFirst reached_;
};

}  // namespace

VectorX feather_weights(const Points& points, const Triangles& inside, const Triangles& outside, double width,
                        const Indices& stops) {
    std::vector<char> is_stop(static_cast<std::size_t>(points.cols()), 0);
    for (const int v : stops) is_stop[v] = 1;
    const VectorX distance = Walk(points, outside, shared_edges(inside, outside), is_stop).distances(width);
    const VectorX share = (distance / width).cwiseMin(1.0);
    VectorX weights = 1.0 - share.array().square() * (3.0 - 2.0 * share.array());
    for (const int v : inside.reshaped()) weights[v] = 1.0;
    for (const int v : stops) weights[v] = 0.0;
    return weights;
}

}  // namespace fairing
