#include "boundary/feather.h"

#include <map>

#include "geometry/neighbourhood.h"
#include "geometry/segments.h"
#include "mesh/edges.h"
#include "mesh/nearest_first.h"

namespace fairing {

namespace {

using Edge = std::array<int, 2>;

std::vector<Edge> shared_edges(const Triangles& inside, const Triangles& outside, int count) {
    const std::vector<Edge> first = make_edges(inside, count).ends, second = make_edges(outside, count).ends;
    std::vector<Edge> shared;
    std::set_intersection(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(shared));
    return shared;
}

// Dijkstra outwards from the boundary: a vertex offers its neighbours its own nearest boundary edge and the edges next
// to that.
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
        if (reached_.lower(vertex, distance_to_segment(points_.col(vertex), points_.col(a), points_.col(b))))
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
    const VectorX distance =
        Walk(points, outside, shared_edges(inside, outside, static_cast<int>(points.cols())), is_stop).distances(width);
    const VectorX share = (distance / width).cwiseMin(1.0);
    VectorX weights = 1.0 - share.array().square() * (3.0 - 2.0 * share.array());
    for (const int v : inside.reshaped()) weights[v] = 1.0;
    for (const int v : stops) weights[v] = 0.0;
    return weights;
}

}  // namespace fairing
