#include "geometry/mean_curvature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "geometry/one_ring_buffer.h"
#include "geometry/virtual_points.h"

namespace fairing {

double CurvatureFit::rise(const Vector3& normal, const Vector3& d) const {
    constexpr double steepest = 0.5;
    const Frame frame(normal);
    const double a = frame.u.dot(d);
    const double b = frame.v.dot(d);
    const double most = steepest * d.norm();
    return std::clamp(0.5 * (x0 * a * a + x1 * a * b + x2 * b * b), -most, most);
}

namespace {

// Of the squared distance, in the tangent plane: points nearer to the normal's line have no direction.
constexpr double no_direction = 1e-24;

// Wedges of the outline from which on its normals count in part, and in full (radians).
constexpr double wide = 2.0 * std::numbers::pi / 3.0;
constexpr double narrow = std::numbers::pi / 2.0;

// Of the farthest point around a vertex of the outline. Fixed vertices stay as near to each other as they were given,
// down to 3e-5 of an edge on voxel meshes and beside booleans, and a normal's error is divided by that distance.
constexpr double least_distance = 0.05;

// Squared distance from which on points around a vertex tell its curvature.
double least_squared(const Patch& patch, const Points& points, int vertex, std::span<const Vector3> around) {
    if (patch.is_free(vertex)) return 0.0;
    double most = 0.0;
    for (const Vector3& p : around) most = std::max(most, (p - points.col(vertex)).squaredNorm());
    return least_distance * least_distance * most;
}

// The angle that the patch fills around a vertex of its outline, in the tangent plane there. A constant of the problem
// where the vertex's neighbours on the outline and its normal are.
double wedge(const Patch& patch, const Points& points, const Points& normals, int vertex) {
    const auto ring = patch.ring(vertex).vertices;
    const Vector3 n = normals.col(vertex);
    const Vector3 first = points.col(ring.front()) - points.col(vertex);
    const Vector3 last = points.col(ring.back()) - points.col(vertex);
    const double angle = std::atan2(first.cross(last).dot(n), first.dot(last) - first.dot(n) * last.dot(n));
    return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

// Where the patch fills less than 90° around a vertex of its outline, curvatures in directions into the patch can't
// tell H: a neighbour in the middle of a wedge of angle ω, ω < 90°, has a negative weight, and the iteration runs away
// from the solution there. The normals of the outline are data too: how they turn along it is II(t, t⊥). With these
// rows all weights of a wedge are positive (they would be from weights of ½ on). Along smooth outlines they would only
// add their own error.
void add_outline_normals(const Patch& patch, const Points& points, const Points& normals, int vertex, double least,
                         CurvatureLeastSquares& fit) {
    const double s = std::clamp((wide - wedge(patch, points, normals, vertex)) / (wide - narrow), 0.0, 1.0);
    if (!(s > 0.0)) return;
    const double weight = s * s * (3.0 - 2.0 * s);
    for (int v : patch.ring(vertex).vertices) {
        const bool is_told = !patch.is_free(v) && (points.col(v) - points.col(vertex)).squaredNorm() >= least;
        if (is_told) fit.add_twist(points.col(v), normals.col(v), weight);
    }
}

}  // namespace

void CurvatureLeastSquares::add_point(const Vector3& point) {
    const Vector3 d = point - centre_;
    const double squared = d.squaredNorm();
    const Eigen::Vector2d t(frame_.u.dot(d), frame_.v.dot(d));
    const double in_plane = t.squaredNorm();
    if (!(in_plane > no_direction * squared)) return;
    const Vector3 row(t.x() * t.x(), t.x() * t.y(), t.y() * t.y());
    equations_.add(row / in_plane, 2.0 * normal_.dot(d) / squared, 1.0);
}

void CurvatureLeastSquares::add_twist(const Vector3& point, const Vector3& normal_there, double weight) {
    const Vector3 d = point - centre_;
    const double squared = d.squaredNorm();
    const Eigen::Vector2d t(frame_.u.dot(d), frame_.v.dot(d));
    const double in_plane = t.squaredNorm();
    if (!(in_plane > no_direction * squared)) return;
    const double product = t.x() * t.y();
    const Vector3 row(-product, 0.5 * (t.x() * t.x() - t.y() * t.y()), product);
    const Vector3 across = t.x() * frame_.v - t.y() * frame_.u;
    equations_.add(row / in_plane, -normal_there.dot(across) / std::sqrt(in_plane * squared), weight);
}

CurvatureFit CurvatureLeastSquares::solve() const {
    NormalEquations<3> equations = equations_;
    equations.add_to_diagonal(1e-9 * equations.trace() + 1e-300);
    const Vector3 x = equations.solve();
    return {x[0], x[1], x[2]};
}

VectorX PatchCurvature::gaussian() const {
    return form.row(0).cwiseProduct(form.row(2)).transpose() - 0.25 * form.row(1).cwiseAbs2().transpose();
}

CurvatureFit fit_curvature(const Vector3& centre, std::span<const Vector3> points, const Vector3& normal) {
    CurvatureLeastSquares fit(centre, normal);
    for (const Vector3& p : points) fit.add_point(p);
    return fit.solve();
}

PatchCurvature patch_curvature(const Patch& patch, const Points& points, FaceGeometry faces, const Points& normals,
                               NormalKind kind) {
    const Points virtual_points = edge_virtual_points(patch, points, faces, normals);
    faces = {};  // the rest needs the room
    const auto virtual_point = [&](int edge) { return virtual_points.col(edge); };
    PatchCurvature curvature{VectorX(patch.vertex_count()), Points(3, patch.vertex_count())};
    for_ranges(patch.vertex_count(), fine_grain, [&](int begin, int end) {
        OneRingBuffer buffer;
        for (int i = begin; i < end; ++i) {
            CurvatureLeastSquares rows(points.col(i), normals.col(i));
            buffer.gather(patch, points, i);
            const auto around = buffer.with_virtual(patch, i, virtual_point);
            const double least = least_squared(patch, points, i, around);
            for (const Vector3& p : around) {
                if ((p - points.col(i)).squaredNorm() >= least) rows.add_point(p);
            }
            if (kind == NormalKind::fitted && !patch.is_free(i) && !patch.ring(i).closed())
                add_outline_normals(patch, points, normals, i, least, rows);
            const CurvatureFit fit = rows.solve();
            curvature.mean[i] = fit.mean();
            curvature.form.col(i) << fit.x0, fit.x1, fit.x2;
        }
    });
    return curvature;
}

}  // namespace fairing
