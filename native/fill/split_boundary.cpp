#include "fill/split_boundary.h"

#include <Eigen/Geometry>

#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double away = 0.1;  // of the shorter edge there: enough to tell two passes apart, too little for another edge

// A short step into the surface at a place of a loop, half-way between the edges there.
Vector3 into_surface(const LoopShape& loop, int k) {
    constexpr double tiny = 1e-300;  // no division by zero
    const Vector3 after = loop.edge(k);
    const Vector3 before = -loop.edge((k + loop.size() - 1) % loop.size());
    const Vector3 normal = loop.normals.col(k);
    const Vector3 flat = after - after.dot(normal) * normal;
    const Vector3 along = flat / std::max(flat.norm(), tiny);
    const Vector3 left = normal.cross(along);
    const double angle = std::atan2(before.dot(left), before.dot(along));
    const double half = 0.5 * (angle > 0.0 ? angle : angle + full_turn);
    return away * std::min(after.norm(), before.norm()) * (std::cos(half) * along + std::sin(half) * left);
}

}  // namespace

SplitBoundary split_boundary(const std::vector<BoundaryLoop>& loops, const Points& points) {
    SplitBoundary result;
    result.old_count = static_cast<int>(points.cols());
    result.source.resize(static_cast<std::size_t>(points.cols()));
    std::iota(result.source.begin(), result.source.end(), 0);
    Indices passes(result.source.size(), 0);
    for (const BoundaryLoop& loop : loops) {
        for (const int v : loop.vertices) ++passes[v];
    }
    std::vector<Vector3> moves(result.source.size(), Vector3::Zero());
    std::vector<char> passed(result.source.size(), 0);
    for (const BoundaryLoop& loop : loops) {
        Indices& own = result.loops.emplace_back(loop.vertices);
        for (int k = 0; k < loop.shape.size(); ++k) {
            const int v = loop.vertices[k];
            if (passes[v] < 2) continue;
            const Vector3 move = into_surface(loop.shape, k);
            if (!passed[v]) {
                passed[v] = 1;
                moves[v] = move;
                continue;
            }
            own[k] = result.count();
            result.source.push_back(v);
            moves.push_back(move);
        }
    }
    result.placed = points(Eigen::all, result.source);
    result.parted = result.placed;
    for (int v = 0; v < result.count(); ++v) result.parted.col(v) += moves[v];
    return result;
}

Indices SplitBoundary::fixed() const {
    Indices all;
    for (const Indices& loop : loops) all.insert(all.end(), loop.begin(), loop.end());
    return all;
}

int SplitBoundary::welded(int vertex) const {
    return vertex < count() ? source[vertex] : vertex - (count() - old_count);
}

}  // namespace fairing
