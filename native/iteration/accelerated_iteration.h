// The accurate iteration: fitted normals, K-preconditioned normal steps and tangential steps, Anderson acceleration.
#pragma once

#include "base/progress.h"
#include "operators/normal_operator.h"
#include "problem/solution.h"

namespace fairing {

// Iterates from `start` (3 × local vertices) to the tolerance of the problem. The positions with the lowest residual
// come back unless the last ones converged.
Solution iterate(const Problem& problem, Workspace& work, Points start, const Progress& progress);

}  // namespace fairing
