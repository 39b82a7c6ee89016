// The solve on the user's mesh alone, from the outline.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// From the membrane by Willmore descent to the accurate iteration; between loops the start that follows the normals
// goes first where it varies less. With all the patience of the problem's options.
Solution solve_directly(const Problem& problem, const Progress& progress);

// The same as a fast path: left at the first sign of trouble, since other ways come next.
Solution try_directly(const Problem& problem, const Progress& progress);

// Whether the surface of `a` has less Willmore energy than that of `b`; no number counts as most.
bool less_bent(const Problem& problem, const Solution& a, const Solution& b);

}  // namespace fairing
