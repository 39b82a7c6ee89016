// The ways for a patch whose size needs no levels.
#pragma once

#include "base/progress.h"
#include "method/ways.h"
#include "problem/solution.h"

namespace fairing {

// Directly on its own mesh, judged by method/accept.
Solution solve_on_own_mesh(const Problem& problem, const Progress& progress);

// The same ways for a table of more.
Way directly();
Way on_proxy();

}  // namespace fairing
