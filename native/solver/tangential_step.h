// Moves vertices within their tangent planes towards their inner-fairness positions (paper §7.3).
#pragma once

#include "fairness/inner_weights.h"
#include "linear/sparse_cholesky.h"

namespace fairing {

// Minimises the Dirichlet energy ½ Σ λ_ij |x_i − x_j|² of the free vertices by displacements across the normals.
class TangentialStep {
public:
    // `fixed_points`: 3 × fixed count. The λ-Laplacian L is constant and factorised here, once.
    TangentialStep(const Patch& patch, const InnerWeights& weights, const Points& fixed_points,
                   const Progress& progress);

    // The positions with Σ_j λ_ij (x_i − x_j) = 0 in all three coordinates: the discrete harmonic map of the outline.
    [[nodiscard]] Points harmonic_positions() const;

    // The free vertices' values of a field that is balanced by λ and has the given values (3 × fixed count) at the
    // fixed ones.
    [[nodiscard]] Points harmonic_extension(const Points& fixed_values) const;

    // ½ Σ λ_ij |x_i − x_j|² up to a constant of the fixed vertices.
    [[nodiscard]] double energy(const Points& points) const;

    // d with P L P d = −P L x, P the projection across the unit normals: conjugate gradients preconditioned by
    // P L⁻¹ P, stopped at a relative residual of 0.05 or after `max_cycles`.
    [[nodiscard]] Points displacement(const Points& points, const Points& normals, int max_cycles = 10) const;

private:
    [[nodiscard]] Points gradient(const Points& points) const;
    [[nodiscard]] Points precondition(const Points& field, const Points& normals) const;

    int free_count_;
    SparseMatrix laplacian_;  // both triangles
    SparseMatrix coupling_;   // λ_ij of free i and fixed j
    Points pull_;             // Σ λ_ij x_j over fixed neighbours j
    SparseCholesky factor_;
};

}  // namespace fairing
