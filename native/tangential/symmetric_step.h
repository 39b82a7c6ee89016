// Tangential steps with a factor of λ.
#pragma once

#include "base/progress.h"
#include "linear/conjugate_gradients.h"
#include "linear/sparse_cholesky.h"
#include "tangential/tangential_step.h"

namespace fairing {

// Minimises the Dirichlet energy ½ Σ λ_ij |x_i − x_j|² of the free vertices.
class SymmetricStep : public TangentialStep {
public:
    SymmetricStep(const Patch& patch, const InnerWeights& weights, const Points& fixed_points,
                  const Progress& progress);

    void hold(const Points& fixed_points) override;
    [[nodiscard]] Points harmonic_positions() const override;
    [[nodiscard]] double merit(const Points& points) const override;
    [[nodiscard]] double imbalance(const Points& points, const Points& normals) const override;
    using TangentialStep::displacement;
    [[nodiscard]] Points displacement(const Points& points, const TangentPlanes& planes,
                                      Effort effort = {}) const override;

    // L⁻¹ of a field over the free vertices.
    [[nodiscard]] Points inverse(const Points& field) const;
    [[nodiscard]] int free_count() const { return free_count_; }

private:
    [[nodiscard]] Points applied(const Points& points) const;  // L
    [[nodiscard]] Points gradient(const Points& points) const;
    [[nodiscard]] Points precondition(const Points& field, const Points& normals) const;
    // Across the normals; `turns`: the term of their turning, or nothing.
    [[nodiscard]] GradientSolution<Points> solve_across(const Points& r, const Points& normals,
                                                        const ShapeOperators& turns, const Effort& effort) const;

    int free_count_;
    SparseMatrix laplacian_;  // both triangles
    SparseMatrix coupling_;   // λ_ij of free i and fixed j
    Points pull_;             // Σ λ_ij x_j over fixed neighbours j
    SparseCholesky factor_;
};

}  // namespace fairing
