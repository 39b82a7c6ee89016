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

// The start that a way before has left, or a new one; nothing where it is not found.
std::shared_ptr<const EasedStart> started(const Problem& problem, const Situation& situation, const Progress& progress);

}  // namespace fairing
