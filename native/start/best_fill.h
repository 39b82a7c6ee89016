// The fill of the boundary that a solve starts from.
#pragma once

#include "base/progress.h"
#include "operators/workspace.h"
#include "problem/problem.h"

namespace fairing {

// Fill of the boundary that has the least Willmore energy of a few bulges (3 × local vertices).
Points best_fill(const Problem& problem, Workspace& work, const Progress& progress);

}  // namespace fairing
