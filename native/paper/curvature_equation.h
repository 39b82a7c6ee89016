// Step I of the factorisation: the Dirichlet problem of the mean curvature (paper §7.1).
#pragma once

#include "geometry/face_geometry.h"

namespace fairing {

// S H = rhs at the free vertices, H known at the fixed ones. S_I is symmetric positive definite while no triangle
// vanishes (§5). Both solvers start from the H that they are given and are not meant to finish. Holds scratch memory.
class CurvatureEquation {
public:
    explicit CurvatureEquation(const Patch& patch) : patch_(patch) {}

    // The diagonal of S; assembled once for each update of the mesh. `stiffness` must outlive the solves.
    void assemble(const Stiffness& stiffness);

    // "local": Gauss–Seidel sweeps over the free vertices.
    void sweep(const VectorX& rhs, int sweeps, VectorX& H) const;
    // "global": conjugate gradient steps, preconditioned by the diagonal.
    void conjugate_gradients(const VectorX& rhs, int steps, VectorX& H);
    // rhs − S H (free count).
    [[nodiscard]] VectorX defect(const VectorX& rhs, const VectorX& H) const;

private:
    // Σ_j w_ij f_j over all neighbours, or over the free ones.
    [[nodiscard]] double neighbour_sum(int i, const VectorX& f) const;
    void multiply(const VectorX& p, VectorX& Sp) const;

    const Patch& patch_;
    const Stiffness* stiffness_ = nullptr;
    VectorX diagonal_;
};

}  // namespace fairing
