// Linear operators along the normals that precondition the outer equation.
#pragma once

#include "base/progress.h"
#include "geometry/face_geometry.h"
#include "linear/anderson.h"
#include "linear/limits.h"
#include "linear/sparse_cholesky.h"
#include "problem/problem.h"
#include "tangential/tangential_step.h"

namespace fairing {

// The choice of operator follows the equation; both are symmetric positive definite.
class NormalOperator {
public:
    virtual ~NormalOperator() = default;
    // Finds the ordering of the factorisation, which does not depend on the surface. Otherwise the first `update` does.
    virtual void prepare() = 0;
    // Assembles the operator for a surface and factorises it. False where it is not positive definite (a surface that
    // has degenerated); solve may not be called then.
    [[nodiscard]] virtual bool update(const Stiffness& stiffness, const Progress& progress) = 0;

    // The operator's inverse applied to one or more columns (free count × k).
    [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs, const Accuracy& accuracy = {}) const {
        return solve_to(rhs, accuracy);
    }

private:
    [[nodiscard]] virtual Eigen::MatrixXd solve_to(const Eigen::MatrixXd& rhs, const Accuracy& accuracy) const = 0;
};

// What an operator is used for: a few solves with a single factor, or many solves or repeated factorisations.
enum class Solves { few, many };

// The one of the problem's equation: Laplace for minimal surfaces, biharmonic for all others, split where the patch is
// large. `layout`: about where the free vertices are (3 × free count), to order the factorisation by; or nothing.
std::unique_ptr<NormalOperator> make_normal_operator(const Problem& problem, Points layout = {},
                                                     Solves solves = Solves::many);

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

// The operators that the stages of a solve share.
struct Workspace {
    std::unique_ptr<NormalOperator> normal;  // of the equation: biharmonic, or Laplace for minimal surfaces
    std::unique_ptr<TangentialStep> tangential;
    bool keeps_factor = false;  // `normal` holds the factor of a surface near the start, which the iteration leaves
    std::unique_ptr<Anderson> history = {};  // of the iterations with that factor; they add to it
};

}  // namespace fairing
