// From a surface that was solved on other vertices to the equation on the user's own.
#pragma once

#include "base/progress.h"
#include "method/accept.h"
#include "operators/workspace.h"
#include "problem/solution.h"

namespace fairing {

// Little where the same equation was solved for before, from near that surface, and ended nowhere: the iteration then
// ends as soon as its steps shrink slower than they do near a solution.
enum class Hope { usual, little };

// Solves the discrete equation on the problem's mesh from `placed`, whose vertices lie on a solved surface. Gives that
// solution where it converges, agrees with that surface and is accepted, `placed` itself otherwise. `work` belongs to
// the problem.
Solution polish(const Problem& problem, Workspace& work, Solution placed, const SolvedSurface& surface, Hope hope,
                const Progress& progress);

}  // namespace fairing
