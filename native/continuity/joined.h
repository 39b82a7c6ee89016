// From a surface with tangent joins to one whose curvature continues that of its surroundings.
#pragma once

#include "base/progress.h"
#include "continuity/known_curvature.h"
#include "operators/boundary_system.h"
#include "operators/normal_operator.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// The least share of the squares of what the tangent join's curvature lacks in waves of twelve vertices and more. What
// is rough comes from noise in the boundary or its surroundings, or from an boundary in steps, and a surface that
// follows it is only wavier. With noise in the H of a torus, an ellipsoid and a cubic cylinder, errors shrank by a
// quarter and more wherever the share was above a third, and grew in some cases below a quarter.
inline constexpr double least_smooth_share = 1.0 / 3.0;

// `tangent`: the answer with Δ_B H = 0. It comes back bit for bit where it has the curvature already, to a hundredth,
// or what it lacks is rough, and smooth to a fiftieth only; and, with the reason in `join`, where no curvature is known
// or noise speaks louder, where it is no accepted solution
// on its proxy mesh, and where the join finds none that is accepted.
Solution joined(const Problem& problem, Solution tangent, const Progress& progress);

// The linear system of one step towards Δ_B² H = 0 with H prescribed on the boundary.
// Let A = S_II, C = S_IB, D = 4M_I. A move u along the normals changes H by −(4M)⁻¹ S_Iᵀ u. κ = M⁻¹ S H is harmonic
// inside, κ_I = −A⁻¹ C κ_B, and its values on the boundary are multipliers. Elimination of the free vertices leaves,
// for the change δ of H on the boundary and for κ_B,
//     G δ + ¼ Cᵀ A⁻¹ D A⁻¹ D A⁻¹ C κ_B = −Cᵀ A⁻¹ D A⁻¹ r,    G = 4M_B + Cᵀ A⁻¹ D A⁻¹ C  (operators/bending),
// with r = (S H − M κ)_I. Three Laplace solves apply it. The second condition is that δ brings H where it is
// prescribed, as far as the modes of the boundary see it. κ_B consists of the same modes.
class JoinOperator {
public:
    // `layout`: about where the free vertices are (3 × free count). The modes must outlive the operator.
    JoinOperator(const Patch& patch, const Points& fixed_points, const BoundaryModes& modes, Points layout);

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
    [[nodiscard]] VectorX lifted(const VectorX& boundary) const;
    // Cᵀ A⁻¹ D.
    [[nodiscard]] VectorX turned(const VectorX& field) const;
    [[nodiscard]] VectorX applied(const VectorX& unknowns) const;
    [[nodiscard]] VectorX preconditioned(const VectorX& rows) const;

    const BoundaryModes& modes_;
    LaplaceOperator laplace_;
    BoundaryCoupling coupling_;
    BoundarySystem boundary_;
    VectorX free_mass_;   // D
    VectorX fixed_mass_;  // 4M_B
    FrontReach beside_;
};

// Δ_B² H = 0 with positions, normals and H given: the multipliers of the boundary (continuity/joined) let Δ_B H
// leave zero there, and it is harmonic inside. Off the curves of `known` it stays zero, as it is for Δ_B H = 0.
// `start`: 3 × local vertices, the surface of the problem with Δ_B H = 0. The residual that comes back is the largest
// difference of Δ_B H from a harmonic function, its history of levels and strategies is empty. `vertices_per_wave`: of
// the fastest waves of H that are met (continuity/known_curvature).
Solution join_curvatures(const Problem& problem, const KnownCurvature& known, const Points& start,
                         int vertices_per_wave, const Progress& progress);

}  // namespace fairing
