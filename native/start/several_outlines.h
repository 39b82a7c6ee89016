// Measures of several boundary loops that are to be joined.
#pragma once

#include "problem/problem.h"

namespace fairing {

// Whether the patch lies between several boundary loops, of which two joined by an edge are one loop, and nothing is
// held elsewhere.
bool joins_outlines(const Problem& problem);

// Relative length of a patch between two boundary loops: the area of the straight tube between them over the sum of
// their squared lengths, L / 4π for a pipe of L radii; 0 between more or fewer. `points`: 3 × local vertices, of which
// the fixed ones count.
double straight_length_between(const Patch& patch, const Points& points);

// Up to this length one surface fits between two boundary loops (a pipe of two and a half radii); two fit a pipe from
// 2π radii on.
inline constexpr double longest_single = 0.2;

// Whether several surfaces may fit between the boundary loops, by one that does (3 × local vertices).
bool may_fit_several(const Patch& patch, const Points& points);

// How far the slope at each fixed vertex is trusted: 1 where the given normals turn by less than 30° along the
// boundary, less and less up to 60°, 0 beyond.
VectorX trust_in_slopes(const Problem& problem);

}  // namespace fairing
