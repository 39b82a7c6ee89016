// The bending energy ∫ |Δx|² of mixed finite elements over any triangles, manifold or not.
#pragma once

#include <Eigen/SparseCore>

#include "base/progress.h"
#include "linear/sparse_cholesky.h"

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
    // (Lᵀ W A⁻¹ L x) at the free vertices (3 × free count) of x (3 × n).
    [[nodiscard]] Points force(const Points& x) const;

private:
    Indices free_;
    VectorX areas_;
    VectorX rows_;                         // W A⁻¹
    Eigen::SparseMatrix<double> whole_;    // L
    Eigen::SparseMatrix<double> columns_;  // of the free vertices
    SparseCholesky factor_;
};

}  // namespace fairing
