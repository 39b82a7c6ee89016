// Step I of the factorisation: the Dirichlet problem of the mean curvature (paper §7.1).
#pragma once

#include "geometry/face_geometry.h"

namespace fairing {

// S H = rhs at the free vertices, H known at the fixed ones. S_I is symmetric positive definite while no triangle
// vanishes (§5). Both solvers begin at the H given and are not meant to converge. Holds scratch memory.
class CurvatureEquation {
public:
    explicit CurvatureEquation(const Patch& patch);

    // S; once for each update of the mesh.
    void assemble(const Stiffness& stiffness);

    // "local": Gauss–Seidel sweeps over the free vertices.
    void sweep(const VectorX& rhs, int sweeps, VectorX& H) const;
    // "global": conjugate gradient steps, preconditioned by the diagonal.
    void conjugate_gradients(const VectorX& rhs, int steps, VectorX& H) const;
    // rhs − S H (free count).
    [[nodiscard]] VectorX defect(const VectorX& rhs, const VectorX& H) const;

private:
    // Σ_j w_ij f_j over the neighbours.
    [[nodiscard]] double neighbour_sum(int i, const VectorX& f) const;

    int free_count_;
    Indices begin_;  // rows of the free vertices: neighbours, their edges and weights
    Indices columns_;
    Indices edges_;
    std::vector<double> weights_;
    VectorX diagonal_;
};

}  // namespace fairing
