// The solve on the user's mesh alone, from the boundary.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// From the membrane by Willmore descent to the accurate iteration; between loops the start that follows the normals
// goes first where it varies less. With all the patience of the problem's options.
Solution solve_directly(const Problem& problem, const Progress& progress);

// The same as a fast path: left at the first sign of trouble, since other strategies come next.
Solution try_directly(const Problem& problem, const Progress& progress);

// Whether the surface of `a` has less Willmore energy than that of `b`; no number counts as most.
bool less_bent(const Problem& problem, const Solution& a, const Solution& b);

// Places of the isolated pins that may have a radius among the fixed vertices: none where nothing else holds the patch,
// or for equations that are not of fourth order.
Indices pins_to_spread(const Problem& problem);

// The surface without pins, lifted to them over `radius` (units of D), on its proxy mesh or else step by step. Nothing
// where it is not accepted. Of 43 patches with one to three pins 35 have it, all that sharp pins lead to; of 19 with
// more 9 of 11.
std::optional<Solution> lift_pins(const Problem& problem, double radius, const Progress& progress);

// `sharp`: an answer in which pins act in a point. It comes back where there are none, and, with the reason in `pins`,
// where no surface with a `radius` is found or accepted: from it, or lifted, unless `pins` says that this was in vain.
// Least variation and soap films stay as they are.
Solution with_spread_pins(const Problem& problem, double radius, Solution sharp, const Progress& progress);

}  // namespace fairing
