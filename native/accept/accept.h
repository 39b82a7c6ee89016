// The one rule by which a solution is accepted.
#pragma once

#include "geometry/target_surface.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// What is wrong with a solution, if anything, however it was found. The checks, in this order: the iteration converged;
// some area is left; the boundary is not met from behind; there are no folds and no crossings that the surface itself
// does not have; the triangles can carry the equation; the iteration took no more steps than a right answer needs.
// Names the bad triangles in the solution.
Flaw flaw_of(const Problem& problem, Solution& solution);

// What converged counts as solved unless it is no answer.
Termination end_of(const Solution& solution);

// Whether no other strategy could do better: accepted, or solved for as much of the load as the surface carries.
bool is_final(const Problem& problem, const Solution& solution);

// A surface that was solved on other vertices, and where the problem's own ones were projected onto it.
struct SolvedSurface {
    const TargetSurface& target;
    const VectorX& mean_curvature;           // at the target's vertices
    double edge;                             // mean length of the target's edges
    const std::vector<SurfacePoint>& where;  // free vertices of the problem's patch
};

// Whether the discrete equation on the problem's mesh (`own`) and a solved surface discretise one surface. A mesh that
// is finer than that surface's carries the equation better: there the other's error decides, elsewhere the two have to
// be as close as both are to the surface on good meshes. Vertices that slid within the surface don't count.
bool agree(const Problem& problem, const Solution& own, const SolvedSurface& surface);

// The share of triangles flatter than a right one of 7 : 1. `points`: 3 × local vertices.
double share_of_poor_triangles(const Patch& patch, const Points& points);

// Whether these are so many that the discrete equation can't be trusted even where it converges: more than a tenth.
bool has_poor_triangles(const Patch& patch, const Points& points);

}  // namespace fairing
