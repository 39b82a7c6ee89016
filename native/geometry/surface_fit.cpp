#include "geometry/surface_fit.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "base/direction.h"
#include "base/progress.h"
#include "geometry/slope_fit.h"

namespace fairing {

namespace {

constexpr int quadratic_rings = 2;
constexpr int cubic_rings = 3;
constexpr int most_rings = 5;
constexpr std::size_t nearest_points = 22;
constexpr std::size_t most_points = 60;

// Adjacency of any triangle list, flat.
struct VertexAdjacency {
    Indices begin;
    Indices neighbours;

    VertexAdjacency(const Triangles& triangles, int vertex_count) : begin(at(vertex_count) + 1, 0) {
        for (int v : triangles.reshaped()) begin[at(v) + 1] += 2;
        for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
        neighbours.resize(at(begin.back()));
        Indices cursor(begin.begin(), begin.end());
        for (const auto triangle : triangles.colwise()) {
            for (int k = 0; k < 3; ++k) {
                neighbours[at(cursor[at(triangle[k])]++)] = triangle[(k + 1) % 3];
                neighbours[at(cursor[at(triangle[k])]++)] = triangle[(k + 2) % 3];
            }
        }
    }
};

// The vertices around one, ring by ring.
class Neighbourhood {
public:
    Neighbourhood(const VertexAdjacency& adjacency, const Points& points)
        : adjacency_(adjacency), points_(points), mark_(static_cast<std::size_t>(points.cols()), none) {}

    void gather(int vertex) {
        ++stamp_;
        std::vector<int> visited(1, vertex);
        mark_[at(vertex)] = stamp_;
        size_of_rings_.assign(1, 0);
        std::size_t ring_begin = 0;
        while (static_cast<int>(size_of_rings_.size()) <= cubic_rings ||
               (visited.size() <= nearest_points && static_cast<int>(size_of_rings_.size()) <= most_rings)) {
            const std::size_t ring_end = visited.size();
            for (std::size_t k = ring_begin; k < ring_end; ++k) visit_neighbours(visited[k], visited);
            ring_begin = ring_end;
            size_of_rings_.push_back(visited.size() - 1);
        }
        by_ring_.clear();
        for (std::size_t k = 1; k < visited.size(); ++k) by_ring_.emplace_back(points_.col(visited[k]));
        sort_by_distance(points_.col(vertex));
    }

    // Few where a mesh is regular: most_points at fans.
    [[nodiscard]] std::span<const Vector3> rings(int count) const {
        return std::span(by_ring_).first(std::min(size_of_rings_[at(count)], most_points));
    }

    [[nodiscard]] std::span<const Vector3> nearest() const {
        return std::span(by_distance_).first(std::min(by_distance_.size(), nearest_points));
    }

private:
    void visit_neighbours(int vertex, std::vector<int>& visited) {
        for (int k = adjacency_.begin[at(vertex)]; k < adjacency_.begin[at(vertex) + 1]; ++k) {
            const int other = adjacency_.neighbours[at(k)];
            if (mark_[at(other)] == stamp_) continue;
            mark_[at(other)] = stamp_;
            visited.push_back(other);
        }
    }

    void sort_by_distance(const Vector3& centre) {
        by_distance_ = by_ring_;
        const std::size_t kept = std::min(by_distance_.size(), nearest_points);
        std::partial_sort(by_distance_.begin(), by_distance_.begin() + std::ptrdiff_t(kept), by_distance_.end(),
                          [&](const Vector3& a, const Vector3& b) {
                              return (a - centre).squaredNorm() < (b - centre).squaredNorm();
                          });
    }

    const VertexAdjacency& adjacency_;
    const Points& points_;
    Indices mark_;
    int stamp_ = none;
    std::vector<std::size_t> size_of_rings_;  // of the first k rings together
    std::vector<Vector3> by_ring_;
    std::vector<Vector3> by_distance_;
};

// The fit whose slopes have the least standard error: it falls with more terms where the surface has them, and rises
// where the points don't determine them. Two rings follow a coarse mesh whatever its quads' proportions; cubics are for
// fine ones; many points for noisy ones.
std::optional<Vector3> best_normal(const Vector3& centre, const Neighbourhood& around, const Vector3& start) {
    struct Candidate {
        std::span<const Vector3> points;
        Degree degree;
    };
    std::optional<SlopeFit> best;
    for (const auto& [points, degree] :
         {Candidate{around.rings(quadratic_rings), Degree::quadratic}, Candidate{around.nearest(), Degree::quadratic},
          Candidate{around.nearest(), Degree::cubic}, Candidate{around.rings(cubic_rings), Degree::cubic}}) {
        const auto fit = fit_slopes(centre, points, start, degree);
        if (fit && (!best || fit->error < best->error)) best = fit;
    }
    return best ? std::optional(best->normal) : std::nullopt;
}

// Coordinates of the triangles' corners within ±1: no product of edges is infinite, and none is lost to denormals.
Points of_unit_size(const Points& points, const Triangles& triangles) {
    double largest = 0.0;
    for (int v : triangles.reshaped()) largest = std::max(largest, points.col(v).cwiseAbs().maxCoeff());
    return largest > 0.0 ? Points(points / largest) : points;
}

Points averaged_at(const Points& points, const Triangles& triangles) {
    Points sums = Points::Zero(3, points.cols());
    for (const auto t : triangles.colwise()) {
        const Vector3 a = points.col(t[0]);
        const Vector3 cross = (points.col(t[1]) - a).cross(Vector3(points.col(t[2]) - a));
        for (int v : t) sums.col(v) += cross;
    }
    for (auto column : sums.colwise()) column = direction(column);
    return sums;
}

}  // namespace

SurroundingNormals surrounding_normals(const Points& given, const Triangles& triangles, const Indices& vertices) {
    const Points points = of_unit_size(given, triangles);
    const VertexAdjacency adjacency(triangles, static_cast<int>(points.cols()));
    const Points averaged = averaged_at(points, triangles);
    Neighbourhood neighbourhood(adjacency, points);
    SurroundingNormals result{Points(3, static_cast<Eigen::Index>(vertices.size())),
                              std::vector<char>(vertices.size(), 0)};
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        checkpoint();
        const int v = vertices[k];
        neighbourhood.gather(v);
        const auto fit = best_normal(points.col(v), neighbourhood, averaged.col(v));
        result.normals.col(static_cast<Eigen::Index>(k)) = fit ? *fit : Vector3(averaged.col(v));
        result.fitted[k] = fit.has_value();
    }
    return result;
}

Points one_sided_normals(const Patch& patch, const Points& points) {
    Indices fixed;
    for (int v = patch.free_count; v < patch.vertex_count(); ++v) fixed.push_back(v);
    return surrounding_normals(points, patch.triangles, fixed).normals;
}

}  // namespace fairing
