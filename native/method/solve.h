// method="global": the steps of a patch's plan, one after the other, and the one judge that ends them.
#pragma once

#include "base/progress.h"
#include "method/plan.h"
#include "problem/solution.h"

namespace fairing {

// Solves the outer equation from the boundary data alone; the caller's interior is not looked at, but for the shape
// that stands in. Carries out plan_for (method/plan): the first surface that flaw_of (accept/accept) accepts is the
// answer. Where the equation has none, the first stand-in that is accepted; `Solution::provenance` says which. Where
// nothing is accepted, what converged comes back before what did not, of that the least bent, with its flaw. Nothing
// else is tried once fewer iterations than usual ran out, or a part of a load was solved. `pin_radius`: of isolated
// pins, units of D; 0 where they act in a point. Deterministic. Throws SolverError where a factorisation breaks down
// at the start, Cancelled.
Solution solve(const Problem& problem, double pin_radius, const Progress& progress);

// Equation::automatic between the ends of tubes, elsewhere harmonic. What is cheap comes first: the harmonic surface,
// that of minimal energy, that of least variation. The first that keeps the girth of its ends is the answer, else the
// one of those accepted that misses least, else what stands in for the harmonic one. `problem` gets the equation that
// was taken. `near` solves a problem from a surface that is known, where there is one, and is tried first.
using Near = std::function<std::optional<Solution>(const Problem&, const Progress&)>;
Solution solve_automatically(Problem& problem, double pin_radius, const Near& near, const Progress& progress);

// The equation alone, between the loops as they are: nothing stands in.
Solution solve_equation_alone(const Problem& problem, const Progress& progress);

// One surface of those that stand in, or the equation's on this mesh alone, at once. Nothing where it is not accepted.
// `near`: 3 × local vertices where the surface of least variation is sought first, and that are the first surface.
std::optional<Solution> solve_stand_in(const Problem& problem, Provenance kind, const Progress& progress,
                                       const Points* near = nullptr);

// The surface of least variation over two boundary loops or more, roughly, from `near` (3 × local vertices). Nothing
// where it is not accepted.
std::optional<Solution> solve_stand_in_roughly(const Problem& problem, const Points& near, const Progress& progress);

}  // namespace fairing
