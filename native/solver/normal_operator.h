// Linear operators along the normals that precondition the outer equation (SOLVER: K_p).
#pragma once

#include <memory>

#include "geometry/face_geometry.h"
#include "linear/sparse_cholesky.h"
#include "solver/problem.h"

namespace fairing {

// The choice of operator follows the equation; both are symmetric positive definite.
class NormalOperator {
public:
    virtual ~NormalOperator() = default;
    // Assembles the operator for a surface and factorises it. False where it is not positive definite (a surface that
    // has degenerated); solve may not be called then.
    [[nodiscard]] virtual bool update(const Stiffness& stiffness, const Progress& progress) = 0;
    // The operator's inverse applied to one or more columns (free count × k).
    [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const { return factor_.solve(rhs); }

protected:
    NormalOperator() = default;
    explicit NormalOperator(Points layout) : factor_(std::move(layout)) {}
    SparseCholesky factor_;
};

// K = S_I (4M)⁻¹ S_Iᵀ over the free vertices, S_I the rows of the free vertices and all columns: close to minus the
// derivative of S_I H by a displacement along the normals (paper §5, §7.2).
class BiharmonicOperator : public NormalOperator {
public:
    // `layout`: about where the free vertices are (3 × free count), to order the factorisation by; or nothing.
    explicit BiharmonicOperator(const Patch& patch, Points layout = {});
    [[nodiscard]] bool update(const Stiffness& stiffness, const Progress& progress) override;

private:
    void build_pattern();
    void find_slots();

    const Patch& patch_;
    SparseMatrix matrix_;
    // Of the products S_ik S_jk, row by row: where row i begins, and the place of each sum within its row.
    std::vector<std::size_t> product_begin_;
    Indices slots_;
};

// S restricted to the free vertices: minus the derivative of 4 M H by a displacement along the normals.
class LaplaceOperator : public NormalOperator {
public:
    explicit LaplaceOperator(const Patch& patch) : patch_(patch) {}
    [[nodiscard]] bool update(const Stiffness& stiffness, const Progress& progress) override;

private:
    const Patch& patch_;
};

// The one of the problem's equation: Laplace for minimal surfaces, biharmonic for all others.
std::unique_ptr<NormalOperator> make_normal_operator(const Problem& problem);

}  // namespace fairing
