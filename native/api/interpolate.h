// Values at some vertices of a mesh, continued over it.
#pragma once

#include "api/input.h"

namespace fairing {

// Rows: the mesh's vertices; columns as those of `given`, whose rows belong to `input.fixed`. Harmonic at the other
// vertices (fairness/harmonic_values); zero where no component holds a fixed vertex. Border vertices that are not fixed
// stay zero, too: a mesh whose border is not all fixed has no use for this. Throws what check_mesh throws, and
// SolverError.
Eigen::MatrixXd interpolate(const MeshInput& input, const Eigen::MatrixXd& given);

}  // namespace fairing
