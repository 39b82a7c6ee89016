// The surface that every run begins with: at once, and always.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"

namespace fairing {

// 3 × local vertices, finite. start/quick_surface; of large patches on a level of some hundred vertices of the user's
// own connectivity, the others between them. Where there is none, the shape before over the boundary as it is now.
// Throws Cancelled.
Points first_surface(const Problem& problem, const Progress& progress);

}  // namespace fairing
