#include "geometry/mean_curvature.h"

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "geometry/limits.h"
#include "geometry/one_ring.h"
#include "geometry/shape_operator.h"

namespace fairing {

double CurvatureFit::rise(const Vector3& normal, const Vector3& d) const {
    constexpr double steepest = 0.5;  // of a chord: the fit says nothing about steeper ones
    const Frame frame(normal);
    const double a = frame.u.dot(d);
    const double b = frame.v.dot(d);
    const double most = steepest * d.norm();
    return std::clamp(0.5 * (x0 * a * a + x1 * a * b + x2 * b * b), -most, most);
}

namespace {

// Wedge of the boundary from which on its normals count in full (radians); in part from the widest corner on.
constexpr double narrow = std::numbers::pi / 2.0;

// Squared distance from which on points around a vertex of the boundary tell its curvature.
double least_squared(const Vector3& centre, std::span<const Vector3> around) {
    double most = 0.0;
    for (const Vector3& p : around) most = std::max(most, (p - centre).squaredNorm());
    return least_reported * least_reported * most;
}

// The angle that the patch fills around a vertex of its boundary, in the tangent plane there. A constant of the problem
// where the vertex's neighbours on the boundary and its normal are.
double wedge(const Patch& patch, const Points& points, const Points& normals, int vertex) {
    const auto ring = patch.ring(vertex).vertices;
    const Vector3 n = normals.col(vertex);
    const Vector3 first = points.col(ring.front()) - points.col(vertex);
    const Vector3 last = points.col(ring.back()) - points.col(vertex);
    const double angle = std::atan2(first.cross(last).dot(n), first.dot(last) - first.dot(n) * last.dot(n));
    return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

// Where the patch fills less than 90° around a vertex of its boundary, curvatures in directions into the patch can't
// tell H: a neighbour in the middle of a wedge of angle ω, ω < 90°, has a negative weight, and the iteration runs away
// from the solution there. The normals of the boundary are data too: how they turn along it is II(t, t⊥). With these
// rows all weights of a wedge are positive (they would be from weights of ½ on). Along smooth boundaries they would
// only add their own error.
void add_boundary_normals(const Patch& patch, const Points& points, const Points& normals, int vertex, double least,
                          CurvatureLeastSquares& fit) {
    const double s =
        std::clamp((widest_corner - wedge(patch, points, normals, vertex)) / (widest_corner - narrow), 0.0, 1.0);
    if (!(s > 0.0)) return;
    const double weight = s * s * (3.0 - 2.0 * s);
    for (int v : patch.ring(vertex).vertices) {
        const bool is_told = !patch.is_free(v) && (points.col(v) - points.col(vertex)).squaredNorm() >= least;
        if (is_told) fit.add_twist(points.col(v) - points.col(vertex), normals.col(v), weight);
    }
}

}  // namespace

VectorX PatchCurvature::gaussian() const {
    return form.row(0).cwiseProduct(form.row(2)).transpose() - 0.25 * form.row(1).cwiseAbs2().transpose();
}

CurvatureFit fit_curvature(const Vector3& centre, std::span<const Vector3> points, const Vector3& normal) {
    CurvatureLeastSquares fit(normal);
    for (const Vector3& p : points) fit.add_point(p - centre);
    return CurvatureFit::of(fit.solve());
}

namespace {

// At a vertex of the boundary.
Vector3 form_at_boundary(const Patch& patch, const Points& points, const Points& virtual_points, const Points& normals,
                         NormalKind kind, int vertex) {
    OneRingBuffer buffer;
    CurvatureLeastSquares rows(normals.col(vertex));
    buffer.gather(patch, points, vertex);
    const auto around = buffer.with_virtual(patch, vertex, [&](int edge) { return virtual_points.col(edge); });
    const double least = least_squared(points.col(vertex), around);
    for (const Vector3& p : around) {
        const Vector3 offset = p - points.col(vertex);
        if (offset.squaredNorm() >= least) rows.add_point(offset);
    }
    if (kind == NormalKind::fitted && !patch.ring(vertex).closed()) {
        add_boundary_normals(patch, points, normals, vertex, least, rows);
    }
    return rows.solve();
}

// At free vertices.
Vector3Of<Lanes> forms_inside(const RingPair& rings, const Vector3Of<Lanes>& normals) {
    CurvatureRows<Lanes> rows(normals);
    for (std::size_t k = 0; k < rings.size(); ++k) rows.add_point(rings.offset(k));
    return rows.solve();
}

}  // namespace

PatchCurvature patch_curvature(const Patch& patch, const Points& points, FaceGeometry faces, const Points& normals,
                               NormalKind kind) {
    const Points virtual_points = edge_virtual_points(patch, points, faces, normals);
    faces = {};  // the rest needs the room
    PatchCurvature curvature{VectorX(), Points(3, patch.vertex_count())};
    for_ranges(patch.free_count, fine_grain, [&](int begin, int end) {
        RingPair rings;
        for (int i = begin; i < end; i += Lanes::count) {
            const LaneIndices vertices = lanes_from(i, end);
            rings.gather(patch, points, vertices);
            rings.append_virtual(patch, virtual_points, vertices);
            scatter(forms_inside(rings, gathered(normals, vertices)), vertices, curvature.form);
        }
    });
    for_ranges(patch.vertex_count() - patch.free_count, fine_grain, [&](int begin, int end) {
        for (int i = patch.free_count + begin; i < patch.free_count + end; ++i) {
            curvature.form.col(i) = form_at_boundary(patch, points, virtual_points, normals, kind, i);
        }
    });
    curvature.mean = 0.5 * (curvature.form.row(0) + curvature.form.row(2)).transpose();
    return curvature;
}

}  // namespace fairing
