// The biharmonic operator of the outer equation, inverted by multigrid.
#pragma once

#include "multigrid/ring_matrix.h"
#include "solver/normal_operator.h"

namespace fairing {

// An approximate inverse of K on one level. Fields have a value for each vertex of the level, 0 at fixed ones.
class BiharmonicCycle {
public:
    virtual ~BiharmonicCycle() = default;
    [[nodiscard]] virtual Field<1> approximate_inverse(Field<1> r) const = 0;
};

// K of a level that is small enough to be factorised.
class FactorisedBiharmonic : public BiharmonicOperator, public BiharmonicCycle {
public:
    explicit FactorisedBiharmonic(const Patch& patch) : BiharmonicOperator(patch), free_count_(patch.free_count) {}
    [[nodiscard]] Field<1> approximate_inverse(Field<1> r) const override;

private:
    int free_count_;
};

// K = S_I (4M)⁻¹ S_Iᵀ without assembling it: conjugate gradients preconditioned by a cycle of Chebyshev smoothing and the
// correction from K of the coarser level's own surface. The interpolation is exact on linear functions and evened out by
// Jacobi steps of the Laplacian: what is interpolated over an irregular mesh has a few times too much energy for an
// operator of fourth order, which is also why a coarser level is solved by two steps of conjugate gradients (K-cycle,
// Notay & Vassilevski 2008) and not by one cycle.
class MultigridBiharmonic : public NormalOperator, public BiharmonicCycle {
public:
    // `weights`: of the transfer's removals, exact on linear functions of the surface.
    MultigridBiharmonic(const Patch& patch, const Transfer& transfer, std::vector<double> weights,
                        const BiharmonicCycle& coarser);
    [[nodiscard]] bool update(const Stiffness& stiffness, const Progress& progress) override;
    [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const override;
    [[nodiscard]] Field<1> approximate_inverse(Field<1> r) const override;

private:
    [[nodiscard]] Field<1> cycle(Field<1> r) const;
    [[nodiscard]] Field<1> coarse_correction(const Field<1>& r) const;
    void apply(const Field<1>& x, Field<1>& y) const;
    void smooth(Field<1>& x, Field<1>& r) const;
    void even_out(Field<1>& field) const;
    void even_out_transposed(Field<1>& field) const;
    [[nodiscard]] double largest_eigenvalue() const;
    [[nodiscard]] VectorX solve_column(const VectorX& rhs) const;

    const Patch& patch_;
    const Transfer& transfer_;
    std::vector<double> weights_;
    const BiharmonicCycle& coarser_;
    RingMatrix stiffness_;
    Field<1> mass_factor_;        // 1 / 4M
    Field<1> inverse_diagonal_;   // of K, 0 at fixed vertices
    Field<1> inverse_laplacian_;  // of |S|'s diagonal, 0 at fixed vertices
    double largest_ = 1.0;        // eigenvalue of D⁻¹K
    Progress progress_;
};

}  // namespace fairing
