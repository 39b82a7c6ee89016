#include "geometry/vertex_normal.h"

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "geometry/shape_operator.h"
#include "geometry/surface_fit.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

// The tilt's regularisation (a larger one leaves an error floor) and the softening of short edges.
constexpr double tilt_regularisation = 0.002;
constexpr double short_edge_softening = 0.2;
constexpr double fade_begin = 0.5;
constexpr double fade_end = 0.9;
// A ring of fewer points can't carry the five unknowns of the fit by itself.
constexpr int smallest_full_ring = 5;
constexpr double least_product = 1e-300;  // of two squared lengths

template <typename Scalar>
Vector3Of<Scalar> unit_or_zero(const Vector3Of<Scalar>& v) {
    const Scalar length = v.norm();
    return v * select(length > 0.0, 1.0 / select(length > 0.0, length, 1.0), 0.0);
}

template <typename Ring, typename Weight>
Vector3Of<typename Ring::Scalar> sum_of_cross_products(const Ring& ring, Weight weight) {
    using Scalar = typename Ring::Scalar;
    using Vector = Vector3Of<Scalar>;
    Vector sum = Vector::Zero();
    if (ring.size() == 0) return sum;
    Vector a = ring.offset_before();
    Scalar a_squared = a.squaredNorm();
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vector& b = ring.offset(k);
        const Scalar b_squared = b.squaredNorm();
        sum += weight(a_squared * b_squared) * a.cross(b);
        a = b;
        a_squared = b_squared;
    }
    return unit_or_zero(sum);
}

template <typename Ring>
Vector3Of<typename Ring::Scalar> averaged_normal_of(const Ring& ring) {
    using Scalar = typename Ring::Scalar;
    return sum_of_cross_products(ring, [](Scalar) { return Scalar(1.0); });
}

template <typename Ring>
Vector3Of<typename Ring::Scalar> max_normal_of(const Ring& ring) {
    using Scalar = typename Ring::Scalar;
    return sum_of_cross_products(
        ring, [](Scalar product) { return select(product > 0.0, 1.0 / select(product > 0.0, product, 1.0), 0.0); });
}

// 1 below fade_begin, 0 above fade_end and for NaN, smooth between.
template <typename Scalar>
Scalar fade(Scalar tilt) {
    Scalar s = (fade_end - tilt) / (fade_end - fade_begin);
    s = select(s > 0.0, s, 0.0);
    s = select(s > 1.0, 1.0, s);
    return s * s * (3.0 - 2.0 * s);
}

template <typename Ring>
typename Ring::Scalar mean_distance(const Ring& ring) {
    typename Ring::Scalar sum = 0.0;
    for (std::size_t k = 0; k < ring.size(); ++k) sum += ring.offset(k).norm();
    return sum / ring.valence();
}

// The quotients of its definition are multiplied out, for one root and two divisions to make a row.
template <typename Ring>
Vector3Of<typename Ring::Scalar> fitted_normal_of(const Ring& ring, const Vector3Of<typename Ring::Scalar>& start) {
    using std::sqrt;
    using Scalar = typename Ring::Scalar;
    const FrameOf<Scalar> frame(start);
    const Scalar h = mean_distance(ring);
    const Scalar softening = short_edge_softening * h * h;
    NormalEquations<5, Scalar> equations;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vector3Of<Scalar>& d = ring.offset(k);
        const Scalar x = frame.u.dot(d);
        const Scalar y = frame.v.dot(d);
        const Scalar in_plane = x * x + y * y;
        const Scalar squared = d.squaredNorm();
        const Scalar product = in_plane * squared;
        const auto is_told = product > least_product;
        const Scalar inverse = 1.0 / select(is_told, product, 1.0);
        const Scalar of_plane = squared * inverse;
        const Scalar reach = 2.0 * h * sqrt(inverse);
        const Scalar weight = select(is_told, squared / (softening + squared), 0.0);
        equations.add({x * x * of_plane, x * y * of_plane, y * y * of_plane, reach * x, reach * y},
                      2.0 * start.dot(d) * in_plane * inverse, weight);
    }
    equations.add_to_diagonal(1e-12 * equations.trace() + 1e-300);
    equations.add_to_diagonal(3, tilt_regularisation);
    equations.add_to_diagonal(4, tilt_regularisation);
    const auto solution = equations.solve();
    const Scalar a = h * solution[3];
    const Scalar b = h * solution[4];
    const Scalar kept = select(start.squaredNorm() > 0.0, fade(Scalar(sqrt(a * a + b * b))), 0.0);
    const Scalar along_u = select(kept > 0.0, kept * a, 0.0);
    const Scalar along_v = select(kept > 0.0, kept * b, 0.0);
    return unit_or_zero(Vector3Of<Scalar>(start - (along_u * frame.u + along_v * frame.v)));
}

// Fitted normals where rings have enough points.
template <typename Ring>
Vector3Of<typename Ring::Scalar> first_fitted_normal(const Ring& ring) {
    const auto start = max_normal_of(ring);
    const auto fitted = fitted_normal_of(ring, start);
    const auto is_full = ring.valence() > smallest_full_ring - 0.5;
    return {select(is_full, fitted[0], start[0]), select(is_full, fitted[1], start[1]),
            select(is_full, fitted[2], start[2])};
}

bool is_prescribed(const Patch& patch, int vertex) {
    return !patch.is_free(vertex) && !patch.pin[static_cast<std::size_t>(vertex)];
}

// Calls normal(ring) for the vertices without a prescribed normal.
template <typename Normal>
Points computed_normals(const Patch& patch, const Points& points, const Points& prescribed, const Normal& normal) {
    Points normals(3, patch.vertex_count());
    for_ranges(patch.free_count, fine_grain, [&](int begin, int end) {
        RingPair rings;
        for (int i = begin; i < end; i += Lanes::count) {
            const LaneIndices vertices = lanes_from(i, end);
            rings.gather(patch, points, vertices);
            scatter(normal(rings), vertices, normals);
        }
    });
    OneRingBuffer buffer;
    for (int i = patch.free_count; i < patch.vertex_count(); ++i) {
        normals.col(i) = is_prescribed(patch, i) ? Vector3(prescribed.col(i - patch.free_count))
                                                 : Vector3(normal(buffer.gather(patch, points, i)));
    }
    return normals;
}

// Second pass: small rings are completed by virtual points between neighbours whose normals are known by now.
void complete_small_rings(const Patch& patch, const Points& points, const FaceGeometry& faces, Points& normals) {
    Indices small;
    for (int i = 0; i < patch.vertex_count(); ++i) {
        if (!is_prescribed(patch, i) && patch.ring(i).valence() < smallest_full_ring) small.push_back(i);
    }
    const auto virtual_point = [&](int edge) { return edge_virtual_point(patch, points, faces, normals, edge); };
    Points completed(3, small.size());
    OneRingBuffer buffer;
    for (std::size_t k = 0; k < small.size(); ++k) {
        const OneRing ring = buffer.gather(patch, points, small[k]);
        const auto around = buffer.with_virtual(patch, small[k], virtual_point);
        completed.col(k) = fitted_normal(ring.centre, around, normals.col(small[k]));
    }
    for (std::size_t k = 0; k < small.size(); ++k) normals.col(small[k]) = completed.col(k);
}

bool touches_free(const Patch& patch, int vertex) {
    const auto ring = patch.ring(vertex).vertices;
    return std::any_of(ring.begin(), ring.end(), [&](int v) { return patch.is_free(v); });
}

}  // namespace

Vector3 averaged_normal(const OneRing& ring) { return averaged_normal_of(ring); }

Vector3 max_normal(const OneRing& ring) { return max_normal_of(ring); }

Vector3 fitted_normal(const Vector3& centre, std::span<const Vector3> points, const Vector3& start) {
    return points.empty() ? start : fitted_normal_of(OneRing{centre, points}, start);
}

Points max_normals(const Patch& patch, const Points& points, const Points& prescribed) {
    return computed_normals(patch, points, prescribed, [](const auto& ring) { return max_normal_of(ring); });
}

Points vertex_normals(const Patch& patch, const Points& points, const FaceGeometry& faces, const Points& prescribed,
                      NormalKind kind) {
    if (kind == NormalKind::averaged) {
        return computed_normals(patch, points, prescribed, [](const auto& ring) { return averaged_normal_of(ring); });
    }
    Points normals =
        computed_normals(patch, points, prescribed, [](const auto& ring) { return first_fitted_normal(ring); });
    complete_small_rings(patch, points, faces, normals);
    return normals;
}

VectorX boundary_angles(const Patch& patch, const Points& actual, const Points& prescribed) {
    VectorX angles = VectorX::Zero(prescribed.cols());
    for (int k = 0; k < prescribed.cols(); ++k) {
        const int v = patch.free_count + k;
        if (patch.pin[v] || !touches_free(patch, v)) continue;
        angles[k] = degrees_between(prescribed.col(k), actual.col(k));
    }
    return angles;
}

}  // namespace fairing
