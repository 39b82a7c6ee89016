// Solves on a mesh of the engine's own, then places the user's vertices on that surface.
#pragma once

#include "solver/problem.h"

namespace fairing {

// The robust way for connectivity that can't carry the equation: a coarse proxy from the membrane, Willmore descent
// with flips and smoothing in between, the accurate iteration there and on a refined proxy, placement of the user's
// vertices by their inner fairness, polish on the user's own mesh where it is an improvement.
// A proxy that fails makes room for the next finer one. When all fail, the least bent of their surfaces comes back
// with the vertices placed on it, and says that it did not converge. `guess`: positions of all vertices that a direct
// solve has found near the surface, or nothing; the proxy starts from them, and the vertices are placed from there
// too (the better of two placements is taken).
Solution solve_on_proxy(const Problem& problem, const std::optional<Points>& guess, const Progress& progress);

// Whether more than a tenth of the triangles are so flat that the discrete equation on them can't be trusted even where
// it converges. `points`: 3 × local vertices.
bool has_poor_triangles(const Patch& patch, const Points& points);

}  // namespace fairing
