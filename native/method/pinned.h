// From a surface with points for pins to one whose pins have a radius.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// `sharp`: the answer in which pins act in a point. It comes back where there are none, and, with the reason in
// `pins`, where no surface with a `radius` (units of D) is found or accepted. Least variation and soap films stay as
// they are.
Solution with_spread_pins(const Problem& problem, double radius, Solution sharp, const Progress& progress);

}  // namespace fairing
