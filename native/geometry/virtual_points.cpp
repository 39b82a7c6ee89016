#include "geometry/virtual_points.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace fairing {

namespace {

// Height of an arc over half the chord, as tan(θ/2) of its end angle θ given by (sin, cos) up to a common factor.
// The cosine is kept positive, so that the angle's tangent is directed towards the other end.
double arc_slope(double sine, double cosine) {
    constexpr double smallest_cosine = 0.1;
    const double b = std::max(cosine, smallest_cosine);
    return sine / (b + std::sqrt(sine * sine + b * b));
}

}  // namespace

Vector3 virtual_point(const NormalChord& chord) {
    const Vector3 midpoint = 0.5 * (chord.a + chord.b);
    const double length = (chord.b - chord.a).norm();
    if (!(length > 0.0)) return midpoint;
    const Vector3 direction = (chord.b - chord.a) / length;
    Vector3 up = chord.triangle_normals - chord.triangle_normals.dot(direction) * direction;
    const double up_length = up.norm();
    if (!(up_length > 1e-12)) return midpoint;
    up /= up_length;
    const double slope_a = arc_slope(-chord.normal_a.dot(direction), chord.normal_a.dot(up));
    const double slope_b = arc_slope(chord.normal_b.dot(direction), chord.normal_b.dot(up));
    return midpoint + up * (0.25 * length * (slope_a + slope_b));
}

Vector3 edge_virtual_point(const Patch& patch, const Points& points, const FaceGeometry& faces, const Points& normals,
                           int edge) {
    const auto [a, b] = patch.edge_ends[at(edge)];
    const auto [left, right] = patch.edge_triangles[at(edge)];
    Vector3 triangle_normals = faces.normals.col(left);
    if (right != none) triangle_normals += faces.normals.col(right);
    return virtual_point({points.col(a), points.col(b), normals.col(a), normals.col(b), triangle_normals});
}

Points edge_virtual_points(const Patch& patch, const Points& points, const FaceGeometry& faces, const Points& normals) {
    Points result(3, patch.edge_count());
    for_ranges(patch.edge_count(), coarse_grain, [&](int begin, int end) {
        for (int e = begin; e < end; ++e) result.col(e) = edge_virtual_point(patch, points, faces, normals, e);
    });
    return result;
}

}  // namespace fairing
