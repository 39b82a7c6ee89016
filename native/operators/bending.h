// The bending energy ∫ |Δx|² of mixed finite elements over any triangles, manifold or not.
#pragma once

#include <Eigen/SparseCore>

#include "base/progress.h"
#include "linear/conjugate_gradients.h"
#include "linear/sparse_cholesky.h"
#include "operators/boundary_system.h"
#include "operators/normal_operator.h"

namespace fairing {

// K = Lᵀ W A⁻¹ L between the free vertices, with L = ½ (cot α + cot β), A a third of the triangles' areas at a vertex
// and W weights of the vertices' curvature: ∫ w |Δx|².
class Bending {
public:
    // `points`: 3 × n; `weights`: n, zero where the surface finds its own slope. `fixed`: vertices that stay, as those
    // without area do. Their rows of L stay in the sum: they are the flow over the boundary, which a slope there would
    // be.
    Bending(const Points& points, const Triangles& triangles, const Indices& fixed, const VectorX& weights);

    [[nodiscard]] const Indices& free() const { return free_; }
    [[nodiscard]] VectorX free_areas() const { return areas_(free_); }
    // Factorises K + diag(factors · A); the free vertices' factors in length⁻⁴. False where it is not positive
    // definite.
    [[nodiscard]] bool factorise(const VectorX& factors, const char* what, const Progress& progress);
    [[nodiscard]] Points solve(const Points& rhs) const { return factor_.solve_points(rhs); }
    // (Lᵀ W A⁻¹ L x) at the free vertices (3 × free count) of x (3 × n), less what the slopes of x over the boundary
    // bring if they stay.
    [[nodiscard]] Points force(const Points& x, bool slopes_stay = false) const;

private:
    Indices free_;
    VectorX areas_;
    VectorX rows_;                         // W A⁻¹
    Eigen::SparseMatrix<double> whole_;    // L
    Eigen::SparseMatrix<double> columns_;  // of the free vertices
    SparseCholesky factor_;
};

// The operator of fourth order along the normals by Laplace solves and a system on the boundary.
// K = S_I (4M)⁻¹ S_Iᵀ as BiharmonicOperator has it, split by free and fixed columns: S_II (4M_I)⁻¹ S_II, which two
// Laplace solves invert, and C (4M_B)⁻¹ Cᵀ, of the rank of the boundary. By Woodbury's identity what is left is a
// system with G = 4M_B + Cᵀ S_II⁻¹ 4M_I S_II⁻¹ C (Glowinski & Pironneau 1979), for conjugate gradients. The factor of
// S_II is far smaller than K's, but a solve takes longer. It is kept in single precision. The inverse is accurate to
// some parts in a thousand of the boundary's share.
class SplitBiharmonicOperator : public NormalOperator {
public:
    // `fixed_points`: 3 × fixed vertices. `layout` as for BiharmonicOperator.
    SplitBiharmonicOperator(const Patch& patch, const Points& fixed_points, Points layout);
    void prepare() override { laplace_.prepare(); }
    [[nodiscard]] bool update(const Stiffness& stiffness, const Progress& progress) override;

private:
    [[nodiscard]] Eigen::MatrixXd solve_to(const Eigen::MatrixXd& rhs, const Accuracy& accuracy) const override;
    [[nodiscard]] VectorX solve_column(const VectorX& rhs, const Accuracy& accuracy) const;

    LaplaceOperator laplace_;
    BoundarySystem boundary_;
    BoundaryCoupling coupling_;
    VectorX free_mass_;  // 4M
    BoundaryRow fixed_mass_;
    FrontReach beside_boundary_;
    mutable KnownDirections known_;  // of G
};

}  // namespace fairing
