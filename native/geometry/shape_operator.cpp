#include "geometry/shape_operator.h"

#include "base/lanes.h"
#include "base/parallel.h"

namespace fairing {

namespace {

// The sign of dn = −II d, where κ(t) = II(t, t).
void put(const CurvatureFit& fit, const Frame& frame, int i, ShapeOperators& shapes) {
    const Eigen::Matrix3d w = -(fit.x0 * frame.u * frame.u.transpose() + fit.x2 * frame.v * frame.v.transpose() +
                                0.5 * fit.x1 * (frame.u * frame.v.transpose() + frame.v * frame.u.transpose()));
    shapes.col(i) << static_cast<float>(w(0, 0)), static_cast<float>(w(1, 1)), static_cast<float>(w(2, 2)),
        static_cast<float>(w(0, 1)), static_cast<float>(w(0, 2)), static_cast<float>(w(1, 2));
}

// Two rows for each neighbour: II t = −dn in the tangent plane.
CurvatureFit fit_turn(const Patch& patch, const Points& points, const Points& normals, int i, const Frame& frame) {
    NormalEquations<3> equations;
    for (const int j : patch.ring(i).vertices) {
        const Vector3 d = points.col(j) - points.col(i);
        const Vector3 turned = normals.col(j) - normals.col(i);
        const double s = frame.u.dot(d);
        const double t = frame.v.dot(d);
        const double squared = s * s + t * t;
        if (!(squared > 0.0) || normals.col(j).isZero()) continue;
        equations.add({s, 0.5 * t, 0.0}, -frame.u.dot(turned), 1.0 / squared);
        equations.add({0.0, 0.5 * s, t}, -frame.v.dot(turned), 1.0 / squared);
    }
    equations.add_to_diagonal(1e-9 * equations.trace() + 1e-300);
    const Vector3 x = equations.solve();
    return {x[0], x[1], x[2]};
}

// Height of an arc over half the chord, as tan(θ/2) of its end angle θ given by (sin, cos) up to a common factor.
// The cosine is kept positive, so that the angle's tangent is directed towards the other end.
template <typename Scalar>
Scalar arc_slope(Scalar sine, Scalar cosine) {
    using std::sqrt;
    constexpr double smallest_cosine = 0.1;  // arcs end at 84°, or chords of folded triangles would blow up
    const Scalar b = select(cosine > smallest_cosine, cosine, smallest_cosine);
    return sine / (b + sqrt(sine * sine + b * b));
}

template <typename Scalar>
Vector3Of<Scalar> virtual_point_of(const NormalChordOf<Scalar>& chord) {
    using Vector = Vector3Of<Scalar>;
    const Vector along = chord.b - chord.a;
    const Scalar length = along.norm();
    const Vector direction = along * (1.0 / select(length > 0.0, length, 1.0));
    const Vector up = chord.triangle_normals - chord.triangle_normals.dot(direction) * direction;
    const Scalar up_length = up.norm();
    const Scalar per_length = 1.0 / select(up_length > 1e-12, up_length, 1.0);
    const Scalar slope_a =
        arc_slope(Scalar(-chord.normal_a.dot(direction)), Scalar(chord.normal_a.dot(up) * per_length));
    const Scalar slope_b =
        arc_slope(Scalar(chord.normal_b.dot(direction)), Scalar(chord.normal_b.dot(up) * per_length));
    // Nothing where the chord has no length or the triangles' normals no direction.
    const Scalar height = select(up_length > 1e-12, 0.25 * length * (slope_a + slope_b) * per_length, 0.0);
    return Scalar(0.5) * (chord.a + chord.b) + up * height;
}

// The chord of an edge of a patch.
NormalChord chord_of(const Patch& patch, const Points& points, const FaceGeometry& faces, const Points& normals,
                     int edge) {
    const auto [a, b] = patch.edge_ends[edge];
    const auto [left, right] = patch.edge_triangles[edge];
    Vector3 triangle_normals = faces.normals.col(left);
    if (right != none) triangle_normals += faces.normals.col(right);
    return {points.col(a), points.col(b), normals.col(a), normals.col(b), triangle_normals};
}

NormalChordOf<Lanes> chords_of(const Patch& patch, const Points& points, const FaceGeometry& faces,
                               const Points& normals, LaneIndices edges) {
    const auto [a0, b0] = patch.edge_ends[edges[0]];
    const auto [a1, b1] = patch.edge_ends[edges[1]];
    const auto [left0, right0] = patch.edge_triangles[edges[0]];
    const auto [left1, right1] = patch.edge_triangles[edges[1]];
    const Vector3 absent = Vector3::Zero();
    const auto normal = [&](int triangle) {
        return triangle == none ? absent.data() : faces.normals.col(triangle).data();
    };
    return {gathered(points, {a0, a1}), gathered(points, {b0, b1}), gathered(normals, {a0, a1}),
            gathered(normals, {b0, b1}),
            gathered(faces.normals, {left0, left1}) + side_by_side(normal(right0), normal(right1))};
}

}  // namespace

ShapeOperators shape_operators(const PatchCurvature& curvature, const Points& normals, int count) {
    ShapeOperators shapes(6, count);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) put(curvature.fit(i), Frame(normals.col(i)), i, shapes);
    });
    return shapes;
}

ShapeOperators shape_operators(const Patch& patch, const Points& points, const Points& normals) {
    ShapeOperators shapes(6, patch.free_count);
    for_ranges(patch.free_count, fine_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const Frame frame(normals.col(i));
            put(fit_turn(patch, points, normals, i, frame), frame, i, shapes);
        }
    });
    return shapes;
}

Vector3 virtual_point(const NormalChord& chord) { return virtual_point_of(chord); }

Vector3 edge_virtual_point(const Patch& patch, const Points& points, const FaceGeometry& faces, const Points& normals,
                           int edge) {
    return virtual_point(chord_of(patch, points, faces, normals, edge));
}

Points edge_virtual_points(const Patch& patch, const Points& points, const FaceGeometry& faces, const Points& normals) {
    Points result(3, patch.edge_count());
    for_ranges(patch.edge_count(), coarse_grain, [&](int begin, int end) {
        for (int e = begin; e < end; e += Lanes::count) {
            const LaneIndices edges = lanes_from(e, end);
            scatter(virtual_point_of(chords_of(patch, points, faces, normals, edges)), edges, result);
        }
    });
    return result;
}

}  // namespace fairing
