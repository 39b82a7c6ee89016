// What is kept where nothing converges: an iteration that fails may end anywhere.
#pragma once

#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Whether the surface of `a` has less Willmore energy than that of `b`; no number counts as most.
bool less_bent(const Problem& problem, const Solution& a, const Solution& b);

// Takes the candidate (3 × local vertices) instead where `solution` did not converge and is more bent. Solutions of
// part of a load and minimal surfaces stay as they are: bending does not compare them.
void keep_less_bent(const Problem& problem, const Points& candidate, Solution& solution);

}  // namespace fairing
