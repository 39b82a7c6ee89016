// The linear system of one step towards Δ_B² H = 0 with H prescribed on the boundary.
#pragma once

#include "continuity/outline_modes.h"
#include "operators/laplace_operator.h"
#include "operators/outline_coupling.h"
#include "operators/outline_system.h"

namespace fairing {

// Let A = S_II, C = S_IB, D = 4M_I. A move u along the normals changes H by −(4M)⁻¹ S_Iᵀ u. κ = M⁻¹ S H is harmonic
// inside, κ_I = −A⁻¹ C κ_B, and its values on the boundary are multipliers. Elimination of the free vertices leaves,
// for the change δ of H on the boundary and for κ_B,
//     G δ + ¼ Cᵀ A⁻¹ D A⁻¹ D A⁻¹ C κ_B = −Cᵀ A⁻¹ D A⁻¹ r,    G = 4M_B + Cᵀ A⁻¹ D A⁻¹ C  (operators/split_operator),
// with r = (S H − M κ)_I. Three Laplace solves apply it. The second condition is that δ brings H where it is
// prescribed, as far as the modes of the boundary see it. κ_B consists of the same modes.
class JoinOperator {
public:
    // `layout`: about where the free vertices are (3 × free count). The modes must outlive the operator.
    JoinOperator(const Patch& patch, const Points& fixed_points, const OutlineModes& modes, Points layout);

    // Factorises A for a surface. False where it is not positive definite.
    [[nodiscard]] bool update(const Stiffness& stiffness, const Progress& progress);

    // κ at the free vertices.
    [[nodiscard]] VectorX harmonic(const VectorX& coefficients) const;

    struct Step {
        VectorX heights;       // along the normals of the free vertices
        VectorX coefficients;  // to be added to those of κ_B
    };
    // `residual`: r at the free vertices; `missing`: what H lacks at the fixed vertices.
    [[nodiscard]] Step solve(const VectorX& residual, const VectorX& missing) const;

private:
    // A⁻¹ C.
    [[nodiscard]] VectorX lifted(const VectorX& outline) const;
    // Cᵀ A⁻¹ D.
    [[nodiscard]] VectorX turned(const VectorX& field) const;
    [[nodiscard]] VectorX applied(const VectorX& unknowns) const;
    [[nodiscard]] VectorX preconditioned(const VectorX& rows) const;

    const OutlineModes& modes_;
    LaplaceOperator laplace_;
    OutlineCoupling coupling_;
    OutlineSystem outline_;
    VectorX free_mass_;   // D
    VectorX fixed_mass_;  // 4M_B
    FrontReach beside_;
};

}  // namespace fairing
