#include "geometry/target_surface.h"

#include <Eigen/Geometry>

#include "geometry/nearest_point.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr std::size_t most_triangles = 64;  // of a search around one

}  // namespace

TargetSurface::TargetSurface(const Patch& patch, const Points& points, const Points& normals, std::vector<char> walls)
    : patch_(patch), points_(points), normals_(normals), walls_(std::move(walls)) {}

// The triangle on the other side, or none.
int TargetSurface::across(int edge, int triangle) const {
    if (!walls_.empty() && walls_[edge] != 0) return none;
    const auto [left, right] = patch_.edge_triangles[edge];
    return left == triangle ? right : left;
}

SurfacePoint TargetSurface::project(const Vector3& position, int start) const {
    constexpr int longest_walk = 500;  // triangles: a bound
    int triangle = start;
    int previous = none;
    for (int step = 0; step < longest_walk; ++step) {
        const auto corners = patch_.triangles.col(triangle);
        const std::array<Vector3, 3> points{points_.col(corners[0]), points_.col(corners[1]), points_.col(corners[2])};
        const Vector3 weights = plane_weights(position, points);
        int outside = 0;
        if (face_normal(triangle).isZero()) break;  // no projection: without an area it would stop every walk
        if (weights.minCoeff(&outside) >= 0.0) return {triangle, weights};
        const int next = across(patch_.triangle_edges(outside, triangle), triangle);
        if (next == none) return {triangle, border_weights(position, points)};
        if (next == previous) break;
        previous = triangle;
        triangle = next;
    }
    return nearest_around(position, triangle);
}

SurfacePoint TargetSurface::nearest_around(const Vector3& position, int start) const {
    Indices found{start};
    SurfacePoint best{start, Vector3::Zero()};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < found.size(); ++k) {
        const int triangle = found[k];
        const auto corners = patch_.triangles.col(triangle);
        const std::array<Vector3, 3> points{points_.col(corners[0]), points_.col(corners[1]), points_.col(corners[2])};
        const Vector3 weights = nearest_weights(position, points);
        const Vector3 foot = weights[0] * points[0] + weights[1] * points[1] + weights[2] * points[2];
        const double distance = (position - foot).squaredNorm();
        if (distance < least) {
            least = distance;
            best = {triangle, weights};
        }
        for (int edge : patch_.triangle_edges.col(triangle)) {
            const int next = across(edge, triangle);
            if (next == none || found.size() == most_triangles) continue;
            if (std::find(found.begin(), found.end(), next) == found.end()) found.push_back(next);
        }
    }
    return best;
}

Vector3 TargetSurface::position(const SurfacePoint& where) const {
    const auto corners = patch_.triangles.col(where.triangle);
    std::array<Vector3, 3> p;
    std::array<Vector3, 3> n;
    for (int k = 0; k < 3; ++k) {
        p[k] = points_.col(corners[k]);
        n[k] = normals_.col(corners[k]);
    }
    // Control point at a third from corner i to corner j, on the tangent plane at i.
    const auto third = [&](int i, int j) {
        return Vector3((2.0 * p[i] + p[j] - (p[j] - p[i]).dot(n[i]) * n[i]) / 3.0);
    };
    Vector3 edge_mean = Vector3::Zero();
    Vector3 sum = Vector3::Zero();
    for (int i = 0; i < 3; ++i) {
        const double w = where.weights[i];
        sum += w * w * w * p[i];
        for (int j = 0; j < 3; ++j) {
            if (i == j) continue;
            const Vector3 control = third(i, j);
            edge_mean += control / 6.0;
            sum += 3.0 * w * w * where.weights[j] * control;
        }
    }
    const Vector3 corner_mean = (p[0] + p[1] + p[2]) / 3.0;
    return sum + 6.0 * where.weights.prod() * (1.5 * edge_mean - 0.5 * corner_mean);
}

Vector3 TargetSurface::face_normal(int triangle) const {
    return area_vector(points_, patch_.triangles.col(triangle)).normalized();
}

// The normal of a flat triangle, or of the nearest one that has an area.
Vector3 TargetSurface::flat_normal(int triangle) const {
    Indices found{triangle};
    for (std::size_t k = 0; k < found.size(); ++k) {
        const Vector3 normal = face_normal(found[k]);
        if (normal.squaredNorm() > 0.5) return normal;
        for (const int edge : patch_.triangle_edges.col(found[k])) {
            const int next = across(edge, found[k]);
            if (next == none || found.size() == most_triangles) continue;
            if (std::find(found.begin(), found.end(), next) == found.end()) found.push_back(next);
        }
    }
    return Vector3::Zero();
}

Vector3 TargetSurface::normal(const SurfacePoint& where) const {
    Vector3 sum = Vector3::Zero();
    for (int k = 0; k < 3; ++k) sum += where.weights[k] * normals_.col(patch_.triangles(k, where.triangle));
    const double size = sum.norm();
    return size > 0.0 ? Vector3(sum / size) : flat_normal(where.triangle);
}

double TargetSurface::interpolate(const VectorX& values, const SurfacePoint& where) const {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += where.weights[k] * values[patch_.triangles(k, where.triangle)];
    return sum;
}

SurfacePoint TargetSurface::at_vertex(int vertex) const {
    int last = none;
    for (const int edge : patch_.ring(vertex).spokes)
        for (const int t : patch_.edge_triangles[edge]) last = std::max(last, t);
    SurfacePoint where{last, Vector3::Zero()};
    for (int k = 0; k < 3; ++k) {
        if (patch_.triangles(k, where.triangle) == vertex) where.weights[k] = 1.0;
    }
    return where;
}

}  // namespace fairing
