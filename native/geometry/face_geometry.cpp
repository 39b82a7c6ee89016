#include "geometry/face_geometry.h"

#include <Eigen/Geometry>

#include "geometry/triangle.h"

namespace fairing {

double triangle_shape(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double squared = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return squared > 0.0 ? 2.0 * std::numbers::sqrt3 * area_vector(a, b, c).norm() / squared : 0.0;
}

void FaceGeometry::update(const Points& points, const Triangles& triangles) {
    const int count = static_cast<int>(triangles.cols());
    cotangents.resize(3, count);
    areas.resize(count);
    normals.resize(3, count);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) measure(points, triangles, t);
    });
}

void FaceGeometry::measure(const Points& points, const Triangles& triangles, int t) {
    const Vector3 a = points.col(triangles(0, t));
    const Vector3 b = points.col(triangles(1, t));
    const Vector3 c = points.col(triangles(2, t));
    const Vector3 ab = b - a;
    const Vector3 bc = c - b;
    const Vector3 ca = a - c;
    const Vector3 cross = ab.cross(-ca);
    const double twice_area = cross.norm();
    const double longest = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()});
    const double safe = safe_twice_area(twice_area, longest);
    cotangents.col(t) << -ab.dot(ca) / safe, -bc.dot(ab) / safe, -ca.dot(bc) / safe;
    areas[t] = 0.5 * twice_area;
    normals.col(t) = twice_area > least_twice_area * longest ? Vector3(cross / twice_area) : Vector3(Vector3::Zero());
}

namespace {

double cotangent_opposite(const FaceGeometry& faces, const Patch& patch, int edge, int triangle) {
    int corner = 0;
    while (patch.triangle_edges(corner, triangle) != edge) ++corner;
    return faces.cotangents(corner, triangle);
}

}  // namespace

void Stiffness::update(const FaceGeometry& faces, const Patch& patch) {
    weights.resize(patch.edge_count());
    for_ranges(patch.edge_count(), coarse_grain, [&](int begin, int end) {
        for (int e = begin; e < end; ++e) {
            const auto [left, right] = patch.edge_triangles[e];
            weights[e] = cotangent_opposite(faces, patch, e, left);
            if (right != none) weights[e] += cotangent_opposite(faces, patch, e, right);
        }
    });
    mass.resize(patch.vertex_count());
    for_ranges(patch.vertex_count(), coarse_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            double twice = 0.0;  // each triangle is met at two of its edges
            for (const int edge : patch.ring(i).spokes) {
                const auto [left, right] = patch.edge_triangles[edge];
                twice += faces.areas[left] + (right != none ? faces.areas[right] : 0.0);
            }
            mass[i] = twice / 6.0;
        }
    });
    // A one-ring collapsed to a point has no area; the equations divide by it.
    const double floor = 1e-14 * std::max(mass.mean(), 1e-300);
    mass = mass.cwiseMax(floor);
}

double Stiffness::diagonal(const Patch& patch, int vertex) const {
    double sum = 0.0;
    for (int edge : patch.ring(vertex).spokes) sum += weights[edge];
    return sum;
}

double total_area(const Points& points, const Triangles& triangles) {
    return sum_over_ranges(static_cast<int>(triangles.cols()), coarse_grain, [&](int begin, int end) {
        double sum = 0.0;
        for (int t = begin; t < end; ++t) sum += 0.5 * area_vector(points, triangles.col(t)).norm();
        return sum;
    });
}

Points summed_normals(const Points& points, const Triangles& triangles) {
    Points sums = Points::Zero(3, points.cols());
    for (const auto t : triangles.colwise()) {
        const Vector3 cross = area_vector(points, t);
        for (int v : t) sums.col(v) += cross;
    }
    return sums;
}

}  // namespace fairing
