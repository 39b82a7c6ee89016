// Surfaces whose pins have a radius.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// As solve_or_else. Where pins that act in a point have no surface, the one without pins is lifted to them over
// `radius` (units of D) before anything else is taken.
Solution solve_pinned(const Problem& problem, double radius, const Progress& progress);

// `sharp`: the answer in which pins act in a point. It comes back where there are none, and, with the reason in
// `pins`, where no surface with a `radius` is found or accepted, from it or from the surface without pins. Least
// variation and soap films stay as they are.
Solution with_spread_pins(const Problem& problem, double radius, Solution sharp, const Progress& progress);

}  // namespace fairing
