// The flattest initial surface: a discrete harmonic map of the boundary.
#pragma once

#include "operators/workspace.h"
#include "problem/problem.h"

namespace fairing {

// The discrete harmonic map of the boundary by the inner-fairness weights (3 × local vertices).
Points membrane(const Problem& problem, const Workspace& work);

}  // namespace fairing
