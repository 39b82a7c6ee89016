// The tangential step of symmetric inner fairness by multigrid.
#pragma once

#include "multigrid/ring_matrix.h"
#include "solver/symmetric_step.h"

namespace fairing {

// An approximate inverse of a λ-Laplacian, symmetric positive definite.
class LaplaceCycle {
public:
    LaplaceCycle() = default;
    LaplaceCycle(const LaplaceCycle&) = delete;
    LaplaceCycle& operator=(const LaplaceCycle&) = delete;
    virtual ~LaplaceCycle() = default;
    // `r` and `x`: 3 × vertices of the level, 0 at fixed ones; x in the right size, r is used up.
    virtual void cycle(Points& r, Points& x) const = 0;
};

// Of the coarsest level, factorised.
class FactorisedLaplacian : public SymmetricStep, public LaplaceCycle {
public:
    using SymmetricStep::SymmetricStep;
    void cycle(Points& r, Points& x) const override;
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
    void cycle(Points& r, Points& x) const override;

private:
    enum class Residual { kept, left };

    void apply(const Points& x, Points& y) const;
    void subtract_product(const Points& x, Points& r) const;
    void smooth(Points& x, Points& r, Residual last) const;

    const Patch& patch_;
    Points fixed_points_;
    const Transfer& transfer_;
    const LaplaceCycle& coarser_;
    RingMatrix laplacian_;
    VectorX inverse_diagonal_;  // 0 at fixed vertices
    // Scratch: fields of this level and of the coarser one.
    mutable Points fine_;
    mutable Points coarse_r_;
    mutable Points coarse_x_;
};

}  // namespace fairing
