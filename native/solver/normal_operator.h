// Linear operators along the normals that precondition the outer equation (SOLVER: K_p).
#pragma once

#include "geometry/face_geometry.h"
#include "solver/sparse_cholesky.h"

namespace fairing {

// K = S_I (4M)⁻¹ S_Iᵀ over the free vertices, S_I the rows of the free vertices and all columns: symmetric positive
// definite, close to minus the derivative of S_I H by a displacement along the normals (METHOD §5, §7.2).
class BiharmonicOperator {
public:
    explicit BiharmonicOperator(const Patch& patch);

    // Assembles K into its fixed pattern and factorises it.
    void update(const Stiffness& stiffness);
    // K⁻¹ of one or more columns (free count × k).
    template <typename Rhs>
    [[nodiscard]] Rhs solve(const Rhs& rhs) const {
        return factor_.solve(rhs);
    }

private:
    template <typename Visit>
    void for_each_column(Visit visit) const;
    void build_pattern();

    const Patch& patch_;
    SparseMatrix matrix_;
    Indices slots_;  // where each product of two entries of a column of S_I is added, in the order of the assembly
    SparseCholesky factor_;
};

// S restricted to the free vertices: −(derivative of 4 M H) by a displacement along the normals.
class LaplaceOperator {
public:
    explicit LaplaceOperator(const Patch& patch);
    void update(const Stiffness& stiffness);
    template <typename Rhs>
    [[nodiscard]] Rhs solve(const Rhs& rhs) const {
        return factor_.solve(rhs);
    }

private:
    const Patch& patch_;
    SparseCholesky factor_;
};

}  // namespace fairing
