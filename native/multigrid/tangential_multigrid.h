// The tangential step of symmetric inner fairness by multigrid.
#pragma once

#include "base/progress.h"
#include "multigrid/ring_matrix.h"
#include "multigrid/transfer.h"
#include "tangential/symmetric_step.h"

namespace fairing {

// An approximate inverse of a λ-Laplacian, symmetric positive definite.
class LaplaceCycle {
public:
    LaplaceCycle() = default;
    LaplaceCycle(const LaplaceCycle&) = delete;
    LaplaceCycle& operator=(const LaplaceCycle&) = delete;
    virtual ~LaplaceCycle() = default;
    // `cycle` inverts the λ-Laplacian over this, about its largest weight, for the range of single precision.
    [[nodiscard]] virtual double scale() const = 0;
    // `r` and `x`: a column for each vertex of the level, 0 at fixed ones; x has the right size; r is overwritten.
    virtual void cycle(SingleField& r, SingleField& x) const = 0;
};

// The operator of the coarsest level, factorised.
class FactorisedLaplacian : public SymmetricStep, public LaplaceCycle {
public:
    FactorisedLaplacian(const Patch& patch, const InnerWeights& weights, const Points& fixed_points,
                        const Progress& progress);
    [[nodiscard]] double scale() const override { return scale_; }
    void cycle(SingleField& r, SingleField& x) const override;

private:
    double scale_ = 1e-300;
};

// A V-cycle: Chebyshev smoothing, the coarser level's own λ.
class MultigridStep : public TangentialStep, public LaplaceCycle {
public:
    // `laplacian`: of λ, over all vertices of the level.
    MultigridStep(const Patch& patch, RingMatrix laplacian, const Points& fixed_points, Restriction restriction,
                  const LaplaceCycle& coarser);
    void hold(const Points& fixed_points) override { fixed_points_ = fixed_points; }
    [[nodiscard]] Points harmonic_positions() const override;
    [[nodiscard]] double merit(const Points& points) const override;
    [[nodiscard]] double imbalance(const Points& points, const Points& normals) const override;
    [[nodiscard]] Points displacement(const Points& points, const TangentPlanes& planes,
                                      Effort effort = {}) const override;
    [[nodiscard]] Points displacement(TurningPlanes&& temporary, Effort effort) const override;
    [[nodiscard]] double scale() const override { return laplacian_.largest; }
    void cycle(SingleField& r, SingleField& x) const override;

private:
    // All of these in units of the scale.
    [[nodiscard]] Points pull(const Points& points) const;
    struct Moves {
        Points d;
        bool positive;  // whether the operator was positive definite
    };
    // The projection across single-precision normals, and the term of its turning, which may be empty.
    struct Planes {
        SingleField normals;
        ShapeOperators turns;
    };
    [[nodiscard]] Moves solve(const Points& pull, const Planes* planes, const Effort& effort) const;
    // Removes the pull's part along the normals.
    [[nodiscard]] Planes project(Points& pull, const Points& normals, ShapeOperators shapes) const;
    [[nodiscard]] Points solve_across(const Points& across, Planes planes, Effort effort) const;
    void subtract_product(const SingleField& x, SingleField& r) const;
    template <typename Write>
    void smooth(const SingleField& r, const Write& write) const;

    const Patch& patch_;
    Points fixed_points_;
    Restriction restriction_;
    const LaplaceCycle& coarser_;
    RingMatrix laplacian_;
    Eigen::VectorXf inverse_diagonal_;  // 0 at fixed vertices
    // Scratch: fields of this level and of the coarser one.
    mutable SingleField fine_;
    mutable SingleField coarse_r_;
    mutable SingleField coarse_x_;
};

}  // namespace fairing
