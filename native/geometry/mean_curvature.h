// Moreton–Séquin mean curvature (paper §6).
#pragma once

#include "geometry/surface_fit.h"
#include "geometry/triangle.h"
#include "geometry/vertex_normal.h"

namespace fairing {

// Second fundamental form II fitted at a vertex, in an arbitrary orthonormal basis of the tangent plane:
// κ(t) = II(t, t) = x0 tx² + x1 tx ty + x2 ty².
struct CurvatureFit {
    double x0 = 0.0;
    double x1 = 0.0;
    double x2 = 0.0;
    static CurvatureFit of(const Vector3& form) { return {form[0], form[1], form[2]}; }
    [[nodiscard]] double mean() const { return 0.5 * (x0 + x2); }  // eq. 10
    [[nodiscard]] double gaussian() const { return x0 * x2 - 0.25 * x1 * x1; }
    // How far the surface rises along the normal at a small tangential displacement d: ½ κ(d) |d|², and no more
    // than half the length of d. In Frame's basis.
    [[nodiscard]] double rise(const Vector3& normal, const Vector3& d) const;
};

// The least squares of eq. 11, row by row. Points at the centre or straight above it carry no direction and are left
// out. Exact on spheres, whatever the rows.
template <typename Scalar>
class CurvatureRows {
public:
    using Vector = Vector3Of<Scalar>;

    // `normal` is a unit vector.
    explicit CurvatureRows(const Vector& normal) : normal_(normal), frame_(normal) {}

    // II(t, t) = κ of the direction t to the point at `offset` from the vertex (eq. 8).
    void add_point(const Vector& offset);

    // II(t, t⊥) from the turn of the unit normals towards the point: −⟨normal_there − normal, t⊥⟩/|d|, t⊥ being t
    // turned by 90° in the tangent plane. `weight`: of this row relative to those of points.
    void add_twist(const Vector& offset, const Vector& normal_there, Scalar weight);

    // x0, x1, x2, regularised by 1e-9 of the trace: finite for any input.
    [[nodiscard]] Vector solve() const;

private:
    // The direction to a point in the tangent plane, and whether there is any.
    [[nodiscard]] auto towards(const Vector& offset) const;

    Vector normal_;
    FrameOf<Scalar> frame_;
    NormalEquations<3, Scalar> equations_;
};
using CurvatureLeastSquares = CurvatureRows<double>;

// Points with less than this share of their squared distance in the tangent plane have no direction.
constexpr double no_direction = 1e-24;

template <typename Scalar>
auto CurvatureRows<Scalar>::towards(const Vector& offset) const {
    const Scalar x = frame_.u.dot(offset);
    const Scalar y = frame_.v.dot(offset);
    const Scalar in_plane = x * x + y * y;
    const Scalar squared = offset.squaredNorm();
    const auto is_told = in_plane > no_direction * squared;
    struct Towards {
        Scalar x, y;
        Scalar in_plane, squared;  // 1 where there is no direction
        decltype(in_plane > squared) is_told;
    };
    return Towards{x, y, select(is_told, in_plane, 1.0), select(is_told, squared, 1.0), is_told};
}

template <typename Scalar>
void CurvatureRows<Scalar>::add_point(const Vector& offset) {
    const auto [x, y, in_plane, squared, is_told] = towards(offset);
    const Scalar share = 1.0 / in_plane;
    equations_.add({x * x * share, x * y * share, y * y * share}, 2.0 * normal_.dot(offset) / squared,
                   select(is_told, Scalar(1.0), 0.0));
}

template <typename Scalar>
void CurvatureRows<Scalar>::add_twist(const Vector& offset, const Vector& normal_there, Scalar weight) {
    using std::sqrt;
    const auto [x, y, in_plane, squared, is_told] = towards(offset);
    const Scalar share = 1.0 / in_plane;
    const Scalar across = x * normal_there.dot(frame_.v) - y * normal_there.dot(frame_.u);
    equations_.add({-x * y * share, 0.5 * (x * x - y * y) * share, x * y * share}, -across / sqrt(in_plane * squared),
                   select(is_told, weight, 0.0));
}

template <typename Scalar>
typename CurvatureRows<Scalar>::Vector CurvatureRows<Scalar>::solve() const {
    NormalEquations<3, Scalar> equations = equations_;
    equations.add_to_diagonal(1e-9 * equations.trace() + 1e-300);
    return equations.solve();
}

// From the normal curvatures κ_j = 2⟨d_j, n⟩/⟨d_j, d_j⟩ of the directions to `points` alone. Negative on a sphere with
// outward normals.
CurvatureFit fit_curvature(const Vector3& centre, std::span<const Vector3> points, const Vector3& normal);

// H at all vertices of a patch, and the form behind it.
struct PatchCurvature {
    VectorX mean;
    Points form;  // x0, x1, x2 in the basis that Frame makes of the normal

    [[nodiscard]] VectorX gaussian() const;
    [[nodiscard]] CurvatureFit fit(int i) const { return {form(0, i), form(1, i), form(2, i)}; }
};

// From the neighbours and a virtual point between every two of them. In corners of the boundary also from the turn of
// the normals along it, unless the normals are averaged ones: that is the paper's discretisation.
PatchCurvature patch_curvature(const Patch& patch, const Points& points, FaceGeometry faces, const Points& normals,
                               NormalKind kind);

}  // namespace fairing
