// The accurate iteration: fitted normals, K-preconditioned normal steps and tangential steps, Anderson acceleration.
#pragma once

#include "base/progress.h"
#include "operators/workspace.h"
#include "problem/solution.h"

namespace fairing {

// Iterates from `start` (3 × local vertices) to the tolerance of the problem. The positions with the lowest residual
// come back unless the last ones converged.
Solution iterate(const Problem& problem, Workspace& work, Points start, const Progress& progress);

// The same with steps that are shorter from the beginning. For outlines whose normals turn much from one vertex to the
// next: H there answers to a move several times as strongly as K expects. Slower where both converge.
Solution iterate_damped(const Problem& problem, Workspace& work, Points start, const Progress& progress);

}  // namespace fairing
