// The initial surface of a solve: a fill of the boundary.
#pragma once

#include "base/progress.h"
#include "operators/workspace.h"
#include "problem/problem.h"

namespace fairing {

// The fill of the boundary with the least Willmore energy among a few bulges (3 × local vertices).
Points best_fill(const Problem& problem, Workspace& work, const Progress& progress);

}  // namespace fairing
