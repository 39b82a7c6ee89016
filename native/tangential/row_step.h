// Tangential steps of λ by rows.
#pragma once

#include "tangential/symmetric_step.h"

namespace fairing {

// Solves P (Λ − 1) x = 0; it has no energy.
class RowStep : public TangentialStep {
public:
    RowStep(const Patch& patch, const RowWeights& weights, const Points& fixed_points, const Progress& progress);

    void hold(const Points& fixed_points) override;
    [[nodiscard]] Points harmonic_positions() const override;
    [[nodiscard]] double merit(const Points& points, const Points& normals) const override;
    [[nodiscard]] double imbalance(const Points& points, const Points& normals) const override;
    using TangentialStep::displacement;
    [[nodiscard]] Points displacement(const Points& points, const TangentPlanes& planes, Effort effort) const override;

private:
    // P (Λx − x) of the free vertices.
    [[nodiscard]] Points imbalances(const Points& points, const Points& normals) const;
    // x with P (1 − Λ) x = P rhs; project(field) applies P.
    template <typename Project>
    [[nodiscard]] Points solve(const Points& rhs, const Project& project, double tolerance, int most_steps) const;

    int free_count_;
    SymmetricStep near_;      // of λ_ij + λ_ji
    SparseMatrix laplacian_;  // 1 − Λ over the free vertices
    SparseMatrix coupling_;   // λ_ij of free i and fixed j
    Points pull_;             // Σ λ_ij x_j over fixed neighbours j
};

}  // namespace fairing
