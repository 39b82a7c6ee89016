// The tangential step of symmetric inner fairness by multigrid.
#pragma once

#include "multigrid/ring_matrix.h"
#include "solver/symmetric_step.h"

namespace fairing {

// An approximate inverse of a λ-Laplacian, symmetric positive definite.
class LaplaceCycle {
public:
    virtual ~LaplaceCycle() = default;
    // `r`: 3 × vertices of the level, 0 at fixed ones.
    [[nodiscard]] virtual Field<3> cycle(Field<3> r) const = 0;
};

// Of the coarsest level, factorised.
class FactorisedLaplacian : public SymmetricStep, public LaplaceCycle {
public:
    using SymmetricStep::SymmetricStep;
    [[nodiscard]] Field<3> cycle(Field<3> r) const override;
};

// A V-cycle: Chebyshev smoothing, the coarser level's own λ.
class MultigridStep : public TangentialStep, public LaplaceCycle {
public:
    // `laplacian`: of λ, over all vertices of the level.
    MultigridStep(const Patch& patch, RingMatrix laplacian, const Points& fixed_points, const Transfer& transfer,
                  const LaplaceCycle& coarser);
    void hold(const Points& fixed_points) override { fixed_points_ = fixed_points; }
    [[nodiscard]] Points harmonic_positions() const override;
    [[nodiscard]] double merit(const Points& points, const Points& normals) const override;
    [[nodiscard]] Points displacement(const Points& points, const Points& normals, int max_cycles = 10) const override;
    [[nodiscard]] Field<3> cycle(Field<3> r) const override;

private:
    [[nodiscard]] Points gradient(const Points& points) const;
    void apply(const Field<3>& x, Field<3>& y) const;
    void smooth(Field<3>& x, Field<3>& r) const;

    const Patch& patch_;
    Points fixed_points_;
    const Transfer& transfer_;
    const LaplaceCycle& coarser_;
    RingMatrix laplacian_;
    Field<1> inverse_diagonal_;  // 0 at fixed vertices
};

}  // namespace fairing
