// The surfaces in place of one that the equation does not have.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Solves as solve_global does (method/ladder). What that accepts is the answer. Where it accepts nothing, the surface
// of least variation with tangent joins stands in. Where that is not accepted either, several boundary loops
// keep the shape before, as smooth as it can be (method/smoothed), or are joined by a loft where none is known
// (method/lofted). Nothing stands in with Otherwise::stop, where the iterations allowed ran out, and where part of a
// load was solved. Where nothing is accepted, the better of the first two comes back with its flaw: fewer crossings
// first, then less variation. `Solution::provenance` says which surface it is. Throws SolverError, Cancelled.
Solution solve_or_else(const Problem& problem, const Progress& progress);

// The same after a solution of solve_global.
Solution or_else(const Problem& problem, Solution solution, const Progress& progress);

// Whether the equation was not seen to have a surface: no answer, although iterations were left, the whole load was
// tried, and not only because the vertices fold on it.
bool lacks_surface(const Solution& solution);

// What stood in for a problem nearby (one of stands_in), at once. Nothing where it is not accepted. `near`: 3 × local
// vertices where the surface of least variation is sought first.
std::optional<Solution> solve_else(const Problem& problem, Provenance kind, const Progress& progress,
                                   const Points* near = nullptr);

// The surface of least variation over two outlines or more, roughly, from `near` (3 × local vertices). Nothing where it
// is not accepted.
std::optional<Solution> solve_else_roughly(const Problem& problem, const Points& near, const Progress& progress);

}  // namespace fairing
