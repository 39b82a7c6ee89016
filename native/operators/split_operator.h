// The operator of fourth order along the normals by Laplace solves and a system on the boundary.
#pragma once

#include "base/progress.h"
#include "linear/known_directions.h"
#include "operators/laplace_operator.h"
#include "operators/outline_coupling.h"
#include "operators/outline_system.h"

namespace fairing {

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
    [[nodiscard]] int unfinished_solves() const override { return known_.unfinished(); }
    [[nodiscard]] VectorX solve_column(const VectorX& rhs, const Accuracy& accuracy) const;

    LaplaceOperator laplace_;
    OutlineSystem outline_;
    OutlineCoupling coupling_;
    VectorX free_mass_;  // 4M
    OutlineRow fixed_mass_;
    FrontReach beside_outline_;
    mutable KnownDirections known_;  // of G
};

}  // namespace fairing
