// Linear operators along the normals that precondition the outer equation.
#pragma once

#include <memory>

#include "base/progress.h"
#include "geometry/face_geometry.h"
#include "linear/accuracy.h"
#include "problem/problem.h"

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
    // Solves so far that missed their accuracy.
    [[nodiscard]] int unfinished() const { return unfinished_solves(); }

private:
    [[nodiscard]] virtual Eigen::MatrixXd solve_to(const Eigen::MatrixXd& rhs, const Accuracy& accuracy) const = 0;
    [[nodiscard]] virtual int unfinished_solves() const { return 0; }
};

// What an operator is used for: a few solves with a single factor, or many solves or repeated factorisations.
enum class Solves { few, many };

// The one of the problem's equation: Laplace for minimal surfaces, biharmonic for all others, split where the patch is
// large. `layout`: about where the free vertices are (3 × free count), to order the factorisation by; or nothing.
std::unique_ptr<NormalOperator> make_normal_operator(const Problem& problem, Points layout = {},
                                                     Solves solves = Solves::many);

}  // namespace fairing
