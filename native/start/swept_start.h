// A start between two outlines that face each other along a bend.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"

namespace fairing {

// 3 × local vertices on the tube swept between the outlines (start/swept_tube), laid there by a harmonic map of the
// connectivity to a cylinder. Nothing where there is no such tube, or where the map tears.
std::optional<Points> swept_start(const Problem& problem, const Progress& progress);

}  // namespace fairing
