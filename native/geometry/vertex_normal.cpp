#include "geometry/vertex_normal.h"

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "geometry/frame.h"
#include "geometry/normal_equations.h"
#include "geometry/one_ring_buffer.h"
#include "geometry/virtual_points.h"

namespace fairing {

namespace {

// The tilt's regularisation (a larger one leaves an error floor) and the softening of short edges.
constexpr double tilt_regularisation = 0.002;
constexpr double short_edge_softening = 0.2;
constexpr double fade_begin = 0.5;
constexpr double fade_end = 0.9;
// A ring of fewer points can't carry the five unknowns of the fit by itself.
constexpr std::size_t smallest_full_ring = 5;

Vector3 unit_or_zero(const Vector3& v) {
    const double length = v.norm();
    return length > 0.0 ? Vector3(v / length) : Vector3(Vector3::Zero());
}

template <typename Weight>
Vector3 sum_of_cross_products(const OneRing& ring, Weight weight) {
    Vector3 sum = Vector3::Zero();
    if (ring.points.empty()) return sum;
    Vector3 a = (ring.closed ? ring.points.back() : ring.points.front()) - ring.centre;
    for (const Vector3& point : ring.points.subspan(ring.closed ? 0 : 1)) {
        const Vector3 b = point - ring.centre;
        sum += weight(a, b) * a.cross(b);
        a = b;
    }
    return unit_or_zero(sum);
}

// 1 below fade_begin, 0 above fade_end, smooth between.
double fade(double tilt) {
    const double s = (tilt - fade_begin) / (fade_end - fade_begin);
    if (s <= 0.0) return 1.0;
    if (s >= 1.0) return 0.0;
    return 1.0 - s * s * (3.0 - 2.0 * s);
}

double mean_distance(const Vector3& centre, std::span<const Vector3> points) {
    double sum = 0.0;
    for (const Vector3& p : points) sum += (p - centre).norm();
    return sum / static_cast<double>(points.size());
}

bool is_prescribed(const Patch& patch, int vertex) {
    return !patch.is_free(vertex) && !patch.pin[static_cast<std::size_t>(vertex)];
}

// normal(ring): of the vertices without a prescribed one.
template <typename Normal>
Points computed_normals(const Patch& patch, const Points& points, const Points& prescribed, const Normal& normal) {
    Points normals(3, patch.vertex_count());
    for_ranges(patch.vertex_count(), fine_grain, [&](int begin, int end) {
        OneRingBuffer buffer;
        for (int i = begin; i < end; ++i) {
            normals.col(i) = is_prescribed(patch, i) ? Vector3(prescribed.col(i - patch.free_count))
                                                     : normal(buffer.gather(patch, points, i));
        }
    });
    return normals;
}

}  // namespace

Vector3 averaged_normal(const OneRing& ring) {
    return sum_of_cross_products(ring, [](const Vector3&, const Vector3&) { return 1.0; });
}

Vector3 max_normal(const OneRing& ring) {
    return sum_of_cross_products(ring, [](const Vector3& a, const Vector3& b) {
        const double product = a.squaredNorm() * b.squaredNorm();
        return product > 0.0 ? 1.0 / product : 0.0;
    });
}

Vector3 fitted_normal(const Vector3& centre, std::span<const Vector3> points, const Vector3& start) {
    if (points.empty() || start.isZero()) return start;
    const Frame frame(start);
    const double h = mean_distance(centre, points);
    NormalEquations<5> equations;
    for (const Vector3& p : points) {
        const Vector3 d = p - centre;
        const double squared = d.squaredNorm();
        Eigen::Vector2d t(frame.u.dot(d), frame.v.dot(d));
        const double in_plane = t.norm();
        if (!(in_plane > 0.0)) continue;
        t /= in_plane;
        const double omega = squared / (h * h);
        const double weight = omega / (short_edge_softening + omega);
        const double reach = 2.0 * h / std::sqrt(squared);
        const NormalEquations<5>::Vector row{t.x() * t.x(), t.x() * t.y(), t.y() * t.y(), reach * t.x(), reach * t.y()};
        equations.add(row, 2.0 * start.dot(d) / squared, weight);
    }
    equations.add_to_diagonal(1e-12 * equations.trace() + 1e-300);
    equations.add_to_diagonal(3, tilt_regularisation);
    equations.add_to_diagonal(4, tilt_regularisation);
    const Eigen::Vector2d tilt = h * equations.solve().tail<2>();
    const double kept = fade(tilt.norm());
    if (!(kept > 0.0)) return start;
    return (start - kept * (tilt.x() * frame.u + tilt.y() * frame.v)).normalized();
}

Points max_normals(const Patch& patch, const Points& points, const Points& prescribed) {
    return computed_normals(patch, points, prescribed, max_normal);
}

Points vertex_normals(const Patch& patch, const Points& points, const FaceGeometry& faces, const Points& prescribed,
                      NormalKind kind) {
    if (kind == NormalKind::averaged) return computed_normals(patch, points, prescribed, averaged_normal);
    const Points normals = computed_normals(patch, points, prescribed, [](const OneRing& ring) {
        const Vector3 start = max_normal(ring);
        return ring.points.size() < smallest_full_ring ? start : fitted_normal(ring.centre, ring.points, start);
    });
    // Second pass: small rings are completed by virtual points between neighbours whose normals are known by now.
    const auto virtual_point = [&](int edge) { return edge_virtual_point(patch, points, faces, normals, edge); };
    Points result = normals;
    OneRingBuffer buffer;
    for (int i = 0; i < patch.vertex_count(); ++i) {
        if (is_prescribed(patch, i) || patch.ring(i).valence() >= smallest_full_ring) continue;
        const OneRing ring = buffer.gather(patch, points, i);
        const auto completed = buffer.with_virtual(patch, i, virtual_point);
        result.col(i) = fitted_normal(ring.centre, completed, normals.col(i));
    }
    return result;
}

}  // namespace fairing
