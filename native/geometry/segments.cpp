#include "geometry/segments.h"

#include <set>

#include "base/progress.h"

namespace fairing {

namespace {

constexpr double touching = 1e-9;  // of the extent
// Share of an edge: the rounding of single precision where coordinates are as large as a hundred edges.
constexpr double on_edge = 1e-5;
constexpr double tiny = std::numeric_limits<double>::min();

// The least distance between inner points of both, and from each end to the other segment.
double distance_between(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    constexpr double parallel = 1e-12;  // of parallel ones an end is among the nearest
    const Vector3 u = b - a;
    const Vector3 v = d - c;
    const Vector3 w = a - c;
    const double size = u.squaredNorm() * v.squaredNorm() - u.dot(v) * u.dot(v);
    double least = std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                             distance_to_segment(d, a, b)});
    if (size > parallel * u.squaredNorm() * v.squaredNorm()) {
        const double s = (u.dot(v) * v.dot(w) - v.squaredNorm() * u.dot(w)) / size;
        const double t = (u.squaredNorm() * v.dot(w) - u.dot(v) * u.dot(w)) / size;
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) least = std::min(least, (w + s * u - t * v).norm());
    }
    return least;
}

Vector3 extent(const VertexPairs& edges, const View<Points>& points) {
    Vector3 low = points.col(edges.front()[0]);
    Vector3 high = low;
    for (const auto& ends : edges) {
        for (const int v : ends) {
            low = low.cwiseMin(points.col(v));
            high = high.cwiseMax(points.col(v));
        }
    }
    return high - low;
}

// visit(one, other): pairs of edges whose boxes, wider by `slack`, meet.
template <typename Visit>
void for_near_pairs(const VertexPairs& edges, const View<Points>& points, double slack, const Visit& visit) {
    const auto low = [&](int e, int axis) { return std::min(points(axis, edges[e][0]), points(axis, edges[e][1])); };
    const auto high = [&](int e, int axis) { return std::max(points(axis, edges[e][0]), points(axis, edges[e][1])); };
    int widest = 0;
    extent(edges, points).maxCoeff(&widest);
    Indices order(edges.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return low(a, widest) < low(b, widest); });
    for (std::size_t i = 0; i < order.size(); ++i) {
        checkpoint(static_cast<int>(i));
        const int one = order[i];
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const int other = order[j];
            if (low(other, widest) - slack > high(one, widest) + slack) break;
            bool meet = true;
            for (int axis = 0; axis < 3 && meet; ++axis) {
                meet = low(one, axis) - slack <= high(other, axis) + slack &&
                       low(other, axis) - slack <= high(one, axis) + slack;
            }
            if (meet) visit(one, other);
        }
    }
}

double longest_of(const VertexPairs& edges, const View<Points>& points) {
    double longest = 0.0;
    for (const auto& [a, b] : edges) longest = std::max(longest, (points.col(b) - points.col(a)).norm());
    return longest;
}

template <typename Row>
void sort_once(std::vector<Row>& rows) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

std::array<int, 2> sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

double distance_to_segment(const Vector3& point, const Vector3& begin, const Vector3& end) {
    const Vector3 along = end - begin;
    const double share = (point - begin).dot(along) / std::max(along.squaredNorm(), tiny);
    return (begin + std::clamp(share, 0.0, 1.0) * along - point).norm();
}

VertexPairs edges_around(const Indices& loop) {
    VertexPairs edges;
    for (std::size_t k = 0; k < loop.size(); ++k) edges.push_back({loop[k], loop[(k + 1) % loop.size()]});
    return edges;
}

std::vector<std::array<int, 4>> crossing_edges(const VertexPairs& edges, const View<Points>& points) {
    std::vector<std::array<int, 4>> found;
    if (edges.empty()) return found;
    const double slack = touching * extent(edges, points).maxCoeff();
    for_near_pairs(edges, points, slack, [&](int one, int other) {
        const auto [a, b] = edges[one];
        const auto [c, d] = edges[other];
        if (a == c || a == d || b == c || b == d) return;
        if (distance_between(points.col(a), points.col(b), points.col(c), points.col(d)) <= slack)
            found.push_back({a, b, c, d});
    });
    return found;
}

Touches touching_edges(const VertexPairs& edges, const View<Points>& points) {
    Touches found;
    if (edges.empty()) return found;
    VertexPairs close;
    const auto look = [&](const std::array<int, 2>& edge, int vertex) {
        const auto [a, b] = edge;
        if (vertex == a || vertex == b) return;
        const Vector3 place = points.col(vertex);
        const double near = on_edge * (points.col(b) - points.col(a)).norm();
        if (distance_to_segment(place, points.col(a), points.col(b)) > near) return;
        const double to_a = (points.col(a) - place).norm();
        const double to_b = (points.col(b) - place).norm();
        if (std::min(to_a, to_b) > 2.0 * near) {
            found.on_edges.push_back({std::min(a, b), std::max(a, b), vertex});
        } else {
            close.push_back(sorted(vertex, to_b < to_a ? b : a));
        }
    };
    for_near_pairs(edges, points, on_edge * longest_of(edges, points), [&](int one, int other) {
        for (const int v : edges[one]) look(edges[other], v);
        for (const int v : edges[other]) look(edges[one], v);
    });
    sort_once(found.on_edges);
    sort_once(close);
    std::set<std::array<int, 2>> joined;
    for (const auto& [a, b] : edges) joined.insert(sorted(a, b));
    for (const auto& pair : close) {
        if (!joined.contains(pair)) found.pairs.push_back(pair);
    }
    return found;
}

}  // namespace fairing
