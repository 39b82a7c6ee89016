// The operator of fourth order along the normals, assembled and factorised.
#pragma once

#include "base/progress.h"
#include "linear/sparse_cholesky.h"
#include "operators/normal_operator.h"

namespace fairing {

// K = S_I (4M)⁻¹ S_Iᵀ over the free vertices, S_I the rows of the free vertices and all columns: close to minus the
// derivative of S_I H by a displacement along the normals (paper §5, §7.2).
class BiharmonicOperator : public NormalOperator {
public:
    // `layout`: about where the free vertices are (3 × free count), to order the factorisation by; or nothing.
    explicit BiharmonicOperator(const Patch& patch, Points layout = {});
    void prepare() override { factor_.analyse_pattern(matrix_); }
    [[nodiscard]] bool update(const Stiffness& stiffness, const Progress& progress) override;
    // The same for K + factor · M; the free vertices' factors in length⁻⁴.
    [[nodiscard]] bool update_with_mass(const Stiffness& stiffness, const VectorX& factors, const Progress& progress);

private:
    [[nodiscard]] Eigen::MatrixXd solve_to(const Eigen::MatrixXd& rhs, const Accuracy& /*accuracy*/) const override {
        return factor_.solve(rhs);
    }
    void build_pattern();
    void find_slots();
    void assemble(const Stiffness& stiffness);

    const Patch& patch_;
    SparseCholesky factor_;
    SparseMatrix matrix_;
    // Sums of the products S_ik S_jk, row by row: where row i begins, and the place of each sum within its row.
    std::vector<std::size_t> product_begin_;
    Indices slots_;
};

}  // namespace fairing
