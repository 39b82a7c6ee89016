// What stands in for a surface where no equation has one.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// The loft (start/loft) with as much of its bulge as makes neither folds nor crossings nor a balloon; its slopes are
// let go as far as that takes. Nothing for one boundary, or where no share is accepted. Instead of it, where these are
// bent less: the membrane after descent of its bending energy (start/globalisation), and where both boundaries face
// each other along a wide bend, the sections swept along it (start/swept_start).
std::optional<Solution> lofted(const Problem& problem, const Progress& progress);

// All of the shape before is smoothed (start/quick_surface), between the tangent planes given. Around its blemishes
// (shape/kinks) what is longer than D stays, then D/2, …, and a unit longer with each unit of distance from there,
// until there are none. Nothing for one boundary, where no shape before is known, or none is accepted.
std::optional<Solution> smoothed(const Problem& problem, const Progress& progress);

}  // namespace fairing
