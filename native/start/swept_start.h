// An initial surface between two boundary loops that face each other along a bend.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "start/swept_tube.h"

namespace fairing {

// Boundary loops as columns of a problem's fixed points, the surface on their left.
std::vector<Indices> boundary_loops(const Patch& patch);

// Nothing where the boundary loops don't face each other along one tube.
std::optional<SweptTube> tube_between(const Problem& problem);
// 3 × local vertices on that tube, by a harmonic map of the connectivity to a cylinder. Nothing where there is no such
// map.
std::optional<Points> swept_start(const Problem& problem, const SweptTube& tube, const Progress& progress);

}  // namespace fairing
