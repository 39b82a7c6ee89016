// An initial surface for minimal surfaces: a membrane over the boundary, then descent of its area.
#pragma once

#include "base/progress.h"
#include "operators/workspace.h"
#include "problem/problem.h"

namespace fairing {

// Repeats x ← the harmonic map from the last surface (Pinkall & Polthier 1993), which never increases the area.
Points descend_area(const Problem& problem, Workspace& work, const Points& start, const Progress& progress);

}  // namespace fairing
