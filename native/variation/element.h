// How much the normal curvatures vary over one triangle, with derivatives.
#pragma once

#include "variation/sheet.h"
#include "variation/stencil.h"

namespace fairing {

using ElementVector = Eigen::Matrix<double, 18, 1>;  // motions (sheet.h) of the six vertices, one after the other
using ElementMatrix = Eigen::Matrix<double, 18, 18>;

struct ElementTerms {
    double energy = 0.0;
    ElementVector gradient = ElementVector::Zero();
    ElementMatrix bending = ElementMatrix::Zero();
    ElementMatrix hessian = ElementMatrix::Zero();  // without the second derivatives of lengths, angles and area
};

// About ∫ ⟨(dκ/ds)²⟩ dA over the triangle: κ the normal curvature along a direction, s the arc length there, ⟨⟩ the mean
// over all directions; in units of length⁻². The normal curvature's derivative along a pair of vertices is
// 6 ⟨n_i + n_j, x_j − x_i⟩ / |x_j − x_i|³ + O(h²), zero on planes, spheres and circular cylinders for any pair;
// a cubic form C(t, t, t) is fitted to the pairs of the stencil. What doesn't fit counts a little, too.
double element_energy(const Sheet& sheet, const Stencil& stencil);
ElementTerms element_terms(const Sheet& sheet, const Stencil& stencil);

// The cubic form C of a triangle in its plane.
struct LocalCubic {
    Eigen::Vector4d coefficients;
    Vector3 e1, e2;
    // C(t, t, t), t the direction of `chord` in the plane.
    [[nodiscard]] double along(const Vector3& chord) const;
};
LocalCubic local_cubic(const Sheet& sheet, const Stencil& stencil);

}  // namespace fairing
