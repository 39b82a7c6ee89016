// The variation of the normal curvatures over one triangle, with derivatives.
#pragma once

#include "variation/unknowns.h"

namespace fairing {

using ElementVector = Eigen::Matrix<double, 18, 1>;  // motions (sheet.h) of the six vertices, one after the other
using ElementMatrix = Eigen::Matrix<double, 18, 18>;

// Sums over a triangle or a whole surface: ∫ ⟨(dκ/ds)²⟩ dA, in units of length⁻², and ∫ dA. κ is the normal curvature
// along a direction, s the arc length there, ⟨⟩ the mean over all directions.
struct ElementSums {
    double variation = 0.0;
    double area = 0.0;
};

// The derivative of the normal curvature along a pair of vertices is 6 ⟨n_i + n_j, x_j − x_i⟩ / |x_j − x_i|³ + O(h²):
// zero on planes, spheres and circular cylinders for any pair. A cubic form C(t, t, t) is fitted to the pairs of the
// stencil, and what doesn't fit counts `misfit` times. That is O(h²), and it ties the normals to the surface: normals
// that lean by −(h²/12) C cancel C along pairs of length h, but not along longer ones. Without this term the normals
// would lean.
//
// They still lean a little. C's part A cos θ, the only one that a lean cancels, counts `lean` times. Equilateral
// triangles are left with 3 w k / (3 w + 2 k) of it (w: misfit, k: lean), where the normals are free: all of it with
// k = 3 w / (3 w − 2). Where all of C has to stand against w alone, w must be large, and what irregular meshes miss is
// then as large.
struct ElementWeights {
    double misfit = 0.0;
    double lean = 1.0;
};
ElementSums element_sums(const Sheet& sheet, const Stencil& stencil, const ElementWeights& weights);

// Derivatives of factors.variation · variation + factors.area · area by the motions. The second ones are split:
// `stretching` is positive semidefinite (Gauss–Newton), `bending` what the pairs' own second derivatives add; those of
// lengths and angles are left out.
struct ElementTerms {
    ElementVector gradient = ElementVector::Zero();
    ElementVector area_gradient = ElementVector::Zero();
    ElementMatrix stretching = ElementMatrix::Zero();
    ElementMatrix bending = ElementMatrix::Zero();
};
ElementTerms element_terms(const Sheet& sheet, const Stencil& stencil, const ElementWeights& weights,
                           const ElementSums& factors);

// Their gradient alone.
ElementVector element_gradient(const Sheet& sheet, const Stencil& stencil, const ElementWeights& weights,
                               const ElementSums& factors);

// 2 Jᵀ ∂²R/∂m², for the residuals R, whose squares `variation` adds up, and motions m: by how much the residuals leave
// their tangent where the motions are taken. `there`: the sheet moved by a small share of them.
ElementVector element_acceleration(const Sheet& sheet, const Sheet& there, const Stencil& stencil,
                                   const ElementWeights& weights, const ElementVector& motions, double share);

// The cubic form of a triangle in its plane.
struct LocalCubic {
    Eigen::Vector4d coefficients;
    Vector3 e1, e2;
    // C(t, t, t), t the direction of `chord` in the plane.
    [[nodiscard]] double along(const Vector3& chord) const;
};
LocalCubic local_cubic(const Sheet& sheet, const Stencil& stencil);

}  // namespace fairing
