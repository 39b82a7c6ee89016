#include "geometry/neighbourhood.h"

#include "base/columns.h"
#include "geometry/face_geometry.h"

namespace fairing {

namespace {

constexpr std::size_t most_points = 60;  // of some rings: only fans have more

}  // namespace

VertexAdjacency::VertexAdjacency(const Triangles& triangles, int vertex_count) : begin(vertex_count + 1, 0) {
    for (int v : triangles.reshaped()) begin[v + 1] += 2;
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    neighbours.resize(begin.back());
    Indices cursor(begin.begin(), begin.end());
    for (const auto triangle : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            neighbours[cursor[triangle[k]]++] = triangle[(k + 1) % 3];
            neighbours[cursor[triangle[k]]++] = triangle[(k + 2) % 3];
        }
    }
}

BallWalk::BallWalk(const VertexAdjacency& adjacency, const Points& points)
    : adjacency_(adjacency), points_(points), seen_(static_cast<std::size_t>(points.cols()), none) {}

const Indices& BallWalk::gather(int centre, double radius) {
    ++stamp_;
    reached_.assign(1, centre);
    seen_[centre] = stamp_;
    for (std::size_t k = 0; k < reached_.size(); ++k) {
        for (int j = adjacency_.begin[reached_[k]]; j < adjacency_.begin[reached_[k] + 1]; ++j) {
            const int v = adjacency_.neighbours[j];
            if (seen_[v] == stamp_ || !((points_.col(v) - points_.col(centre)).norm() <= radius)) continue;
            seen_[v] = stamp_;
            reached_.push_back(v);
        }
    }
    return reached_;
}

Neighbourhood::Neighbourhood(const VertexAdjacency& adjacency, const Points& points, Reach reach)
    : adjacency_(adjacency), points_(points), reach_(reach), mark_(static_cast<std::size_t>(points.cols()), none) {}

void Neighbourhood::gather(int vertex) {
    ++stamp_;
    visited_.assign(1, vertex);
    mark_[vertex] = stamp_;
    size_of_rings_.assign(1, 0);
    std::size_t ring_begin = 0;
    while (static_cast<int>(size_of_rings_.size()) <= reach_.rings ||
           (visited_.size() <= reach_.points && static_cast<int>(size_of_rings_.size()) <= most_rings)) {
        const std::size_t ring_end = visited_.size();
        for (std::size_t k = ring_begin; k < ring_end; ++k) visit_neighbours(visited_[k]);
        ring_begin = ring_end;
        size_of_rings_.push_back(visited_.size() - 1);
    }
    by_ring_.clear();
    for (std::size_t k = 1; k < visited_.size(); ++k) by_ring_.emplace_back(points_.col(visited_[k]));
    sort_by_distance(points_.col(vertex));
}

std::span<const Vector3> Neighbourhood::rings(int count) const {
    return std::span(by_ring_).first(std::min(size_of_rings_[count], most_points));
}

std::span<const Vector3> Neighbourhood::nearest(std::size_t count) const {
    return std::span(by_distance_).first(std::min(by_distance_.size(), count));
}

void Neighbourhood::visit_neighbours(int vertex) {
    for (int k = adjacency_.begin[vertex]; k < adjacency_.begin[vertex + 1]; ++k) {
        const int other = adjacency_.neighbours[k];
        if (mark_[other] == stamp_) continue;
        mark_[other] = stamp_;
        visited_.push_back(other);
    }
}

void Neighbourhood::sort_by_distance(const Vector3& centre) {
    distances_.clear();
    for (const Vector3& point : by_ring_) distances_.push_back({(point - centre).squaredNorm(), point});
    const std::size_t kept = std::min(distances_.size(), reach_.points);
    std::partial_sort(distances_.begin(), distances_.begin() + std::ptrdiff_t(kept), distances_.end(),
                      [](const Distant& a, const Distant& b) { return a.squared < b.squared; });
    by_distance_.clear();
    for (std::size_t k = 0; k < kept; ++k) by_distance_.push_back(distances_[k].point);
}

Points averaged_normals(const Points& points, const Triangles& triangles) {
    Points normals = summed_normals(points, triangles);
    for (auto normal : normals.colwise()) normal = direction(Vector3(normal));
    return normals;
}

double mean_edge(const Patch& patch, const Points& points) {
    double sum = 0.0;
    for (const auto& [a, b] : patch.edge_ends) sum += (points.col(a) - points.col(b)).norm();
    return sum / patch.edge_count();
}

double mean_spoke(const Patch& patch, const Points& points, int vertex) {
    const auto ring = patch.ring(vertex).vertices;
    double sum = 0.0;
    for (const int w : ring) sum += (points.col(w) - points.col(vertex)).norm();
    return sum / static_cast<double>(ring.size());
}

}  // namespace fairing
