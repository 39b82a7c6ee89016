// From a surface that was solved on other vertices to the equation on the user's own.
#pragma once

#include "solver/globalisation.h"

namespace fairing {

// The discrete equation on the problem's mesh from `placed`, whose vertices lie on a solved surface, where it
// converges near that; `placed` itself otherwise. `work`: of the problem.
Solution polish(const Problem& problem, Workspace& work, Solution placed, const Progress& progress);

}  // namespace fairing
