// The Laplace–Beltrami operator of the free vertices, factorised.
#pragma once

#include "base/progress.h"
#include "linear/sparse_cholesky.h"
#include "operators/normal_operator.h"

namespace fairing {

// S restricted to the free vertices: minus the derivative of 4 M H by a displacement along the normals.
class LaplaceOperator : public NormalOperator {
public:
    // `layout`: about where the free vertices are (3 × free count), to order the factorisation by; or nothing.
    explicit LaplaceOperator(const Patch& patch, Points layout = {}, Kept kept = Kept::doubles);
    void prepare() override;
    [[nodiscard]] bool update(const Stiffness& stiffness, const Progress& progress) override;
    // Valid until the next update.
    [[nodiscard]] const SparseCholesky& factor() const { return factor_; }

private:
    [[nodiscard]] Eigen::MatrixXd solve_to(const Eigen::MatrixXd& rhs, const Accuracy& /*accuracy*/) const override {
        return factor_.solve(rhs);
    }
    // Its lower triangle, assembled for each factorisation and not kept, to save memory.
    [[nodiscard]] SparseMatrix lower(const Stiffness& stiffness) const;

    const Patch& patch_;
    SparseCholesky factor_;
};

}  // namespace fairing
