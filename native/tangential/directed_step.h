// Tangential steps of λ that are not symmetric: shape preserving and custom ones.
#pragma once

#include "base/progress.h"
#include "linear/sparse_lu.h"
#include "tangential/tangential_step.h"

namespace fairing {

// Solves P (Λ − 1) x = 0; it has no energy.
class DirectedStep : public TangentialStep {
public:
    DirectedStep(const Patch& patch, const RowWeights& weights, const Points& fixed_points, const Progress& progress);

    void hold(const Points& fixed_points) override;
    [[nodiscard]] Points harmonic_positions() const override;
    [[nodiscard]] double merit(const Points& points, const Points& normals) const override;
    [[nodiscard]] double imbalance(const Points& points, const Points& normals) const override;
    using TangentialStep::displacement;
    [[nodiscard]] Points displacement(const Points& points, const TangentPlanes& planes, Effort effort) const override;

private:
    // P (Λx − x) of the free vertices.
    [[nodiscard]] Points imbalances(const Points& points, const Points& normals) const;
    [[nodiscard]] Points solve(const Points& rhs) const;

    int free_count_;
    SparseMatrix laplacian_;  // 1 − Λ over the free vertices
    SparseMatrix coupling_;   // λ_ij of free i and fixed j
    Points pull_;             // Σ λ_ij x_j over fixed neighbours j
    SparseLu factor_;
};

}  // namespace fairing
