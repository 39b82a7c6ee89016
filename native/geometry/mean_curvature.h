// Moreton–Séquin mean curvature (paper §6).
#pragma once

#include <span>

#include "geometry/frame.h"
#include "geometry/normal_equations.h"
#include "geometry/vertex_normal.h"

namespace fairing {

// Second fundamental form II fitted at a vertex, in an arbitrary orthonormal basis of the tangent plane:
// κ(t) = II(t, t) = x0 tx² + x1 tx ty + x2 ty².
struct CurvatureFit {
    double x0 = 0.0;
    double x1 = 0.0;
    double x2 = 0.0;
    [[nodiscard]] double mean() const { return 0.5 * (x0 + x2); }  // eq. 10
    [[nodiscard]] double gaussian() const { return x0 * x2 - 0.25 * x1 * x1; }
    // How far the surface rises along the normal at a small tangential displacement d: ½ κ(d) |d|², and no more
    // than half the length of d. In Frame's basis.
    [[nodiscard]] double rise(const Vector3& normal, const Vector3& d) const;
};

// The least squares of eq. 11, row by row. Points at the centre or straight above it carry no direction and are left
// out. Exact on spheres, whatever the rows.
class CurvatureLeastSquares {
public:
    // `normal` is a unit vector.
    CurvatureLeastSquares(const Vector3& centre, const Vector3& normal)
        : centre_(centre), normal_(normal), frame_(normal) {}

    // II(t, t) = κ of the direction t to the point (eq. 8).
    void add_point(const Vector3& point);

    // II(t, t⊥) from the turn of the unit normals towards `point`: −⟨normal_there − normal, t⊥⟩/|d|, t⊥ being t turned
    // by 90° in the tangent plane. `weight`: of the row beside those of points.
    void add_twist(const Vector3& point, const Vector3& normal_there, double weight = 1.0);

    // Regularised by 1e-9 of the trace: finite for any input.
    [[nodiscard]] CurvatureFit solve() const;

private:
    Vector3 centre_;
    Vector3 normal_;
    Frame frame_;
    NormalEquations<3> equations_;
};

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

// From the neighbours and a virtual point between every two of them. In corners of the outline also from the turn of
// the normals along it, unless the normals are averaged ones: that is the paper's discretisation.
PatchCurvature patch_curvature(const Patch& patch, const Points& points, FaceGeometry faces, const Points& normals,
                               NormalKind kind);

}  // namespace fairing
