#include "geometry/surface_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "base/direction.h"
#include "base/progress.h"
#include "geometry/frame.h"

namespace fairing {

namespace {

constexpr std::size_t wanted_points = 22;
constexpr std::size_t cubic_points = 16;
constexpr std::size_t quadric_points = 8;
constexpr int most_rings = 5;

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

// Grows rings around a vertex until there are enough points, then keeps the nearest ones.
class Neighbourhood {
public:
    Neighbourhood(const VertexAdjacency& adjacency, const Points& points)
        : adjacency_(adjacency), points_(points), seen_(static_cast<std::size_t>(points.cols()), none) {}

    std::span<const Vector3> around(int vertex) {
        visited_.assign(1, vertex);
        seen_[at(vertex)] = vertex;
        std::size_t ring_begin = 0;
        for (int ring = 0; ring < most_rings && visited_.size() <= wanted_points; ++ring) {
            const std::size_t ring_end = visited_.size();
            for (std::size_t k = ring_begin; k < ring_end; ++k) visit_neighbours(visited_[k], vertex);
            ring_begin = ring_end;
        }
        nearest_.clear();
        for (std::size_t k = 1; k < visited_.size(); ++k) nearest_.emplace_back(points_.col(visited_[k]));
        const Vector3 centre = points_.col(vertex);
        const std::size_t kept = std::min(nearest_.size(), wanted_points);
        std::partial_sort(nearest_.begin(), nearest_.begin() + std::ptrdiff_t(kept), nearest_.end(),
                          [&](const Vector3& a, const Vector3& b) {
                              return (a - centre).squaredNorm() < (b - centre).squaredNorm();
                          });
        nearest_.resize(kept);
        return nearest_;
    }

private:
    void visit_neighbours(int vertex, int mark) {
        for (int k = adjacency_.begin[at(vertex)]; k < adjacency_.begin[at(vertex) + 1]; ++k) {
            const int other = adjacency_.neighbours[at(k)];
            if (seen_[at(other)] == mark) continue;
            seen_[at(other)] = mark;
            visited_.push_back(other);
        }
    }

    const VertexAdjacency& adjacency_;
    const Points& points_;
    Indices seen_;
    Indices visited_;
    std::vector<Vector3> nearest_;
};

// What the quadratic terms grow with (and the cubic ones likewise): the square of the distance in the plane, or that in
// space, as normal curvatures by chords do (paper eq. 8): so a sphere is met exactly, whatever the points.
enum class Terms { planar, spatial };

// Gradient at the centre of the best height polynomial over the plane across `normal`; coordinates in units of `scale`.
std::optional<Eigen::Vector2d> height_gradient(const Vector3& centre, std::span<const Vector3> points,
                                               const Vector3& normal, double scale, Terms terms) {
    const bool cubic = points.size() >= cubic_points;
    const Frame frame(normal);
    Eigen::MatrixXd A(static_cast<Eigen::Index>(points.size()), cubic ? 9 : 5);
    VectorX rhs(A.rows());
    for (Eigen::Index k = 0; k < A.rows(); ++k) {
        const Vector3 d = (points[static_cast<std::size_t>(k)] - centre) / scale;
        const double u = frame.u.dot(d);
        const double v = frame.v.dot(d);
        const double weight = std::exp(-d.squaredNorm());
        const double stretch = terms == Terms::spatial ? d.norm() / std::max(std::hypot(u, v), 1e-12) : 1.0;
        A.row(k).head<5>() << u, v, u * u, u * v, v * v;
        A.row(k).segment<3>(2) *= stretch * stretch;
        if (cubic) {
            A.row(k).tail<4>() << u * u * u, u * u * v, u * v * v, v * v * v;
            A.row(k).tail<4>() *= stretch * stretch * stretch;
        }
        A.row(k) *= weight;
        rhs[k] = weight * normal.dot(d);
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
    qr.setThreshold(1e-6);
    if (qr.rank() < A.cols()) return std::nullopt;
    return Eigen::Vector2d(qr.solve(rhs).head<2>());
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

std::optional<Vector3> fit_normal(const Vector3& centre, std::span<const Vector3> points, const Vector3& start,
                                  Terms terms) {
    constexpr int most_rounds = 8;
    constexpr double settled = 1e-12;
    constexpr double cos_of_widest_turn = 0.5;
    if (points.size() < quadric_points || start.isZero()) return std::nullopt;
    double scale = 0.0;
    for (const Vector3& p : points) scale = std::max(scale, (p - centre).norm());
    if (!(scale > 0.0)) return std::nullopt;
    Vector3 normal = start;
    for (int round = 0; round < most_rounds; ++round) {
        const auto gradient = height_gradient(centre, points, normal, scale, terms);
        if (!gradient || !gradient->allFinite()) return std::nullopt;
        const Frame frame(normal);
        normal = (normal - gradient->x() * frame.u - gradient->y() * frame.v).normalized();
        if (gradient->norm() < settled) break;
    }
    if (normal.dot(start) < cos_of_widest_turn) return std::nullopt;
    return normal;
}

}  // namespace

std::optional<Vector3> surface_fit_normal(const Vector3& centre, std::span<const Vector3> points,
                                          const Vector3& start) {
    const auto planar = fit_normal(centre, points, start, Terms::planar);
    if (!planar) return std::nullopt;
    // Beyond a crease the distance in space misleads: there the two differ.
    constexpr double cos_of_crease = 0.94;  // 20°
    const auto spatial = fit_normal(centre, points, *planar, Terms::spatial);
    return spatial && spatial->dot(*planar) > cos_of_crease ? spatial : planar;
}

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
        const auto fit = surface_fit_normal(points.col(v), neighbourhood.around(v), averaged.col(v));
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
