// Diagnostics of a patch before and after its solve.
#pragma once

#include "base/errors.h"
#include "base/types.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Whether inner-fairness weights can be read off a reference mesh (3 × local vertices); warns REFERENCE_UNUSABLE where
// more than a tenth of it is slivers, collapsed or turned over, or the whole one-ring of a free vertex has no area.
bool is_usable_reference(const Patch& patch, const Points& reference, Diagnostics& warnings);

// Whether the triangles at some free vertex all lack area (3 × local vertices).
bool has_collapsed_fan(const Patch& patch, const Points& points);

// REFERENCE_UNUSABLE (figure `old_skin`) where no detail can be read; FLIPPED_TRIANGLES where detail flips triangles
// (local numbers).
void warn_of_missing_detail(Diagnostics& warnings);
void warn_of_folded_detail(const Patch& patch, const Indices& triangles, Diagnostics& warnings);

// D and the largest move, in units of D, at which the solve stops.
struct Precision {
    double diameter;
    double tolerance;
};
// PRECISION where neighbouring floating-point numbers lie farther apart than that, or than a thousandth of the border
// edges. `input`: positions of all input vertices.
void warn_of_precision(const Patch& patch, const View<Points>& input, const Precision& wanted, Diagnostics& warnings);

// Why there is no solution: NOT_CONVERGED with the free vertices, and FOLDED with the triangles where the surface was
// found; NOT_CONVERGED then has their number as the figure "folds". `angles`: degrees at the fixed vertices between the
// normals prescribed and obtained.
Diagnostics failures_of(const Patch& patch, const Solution& solution, Termination end, const VectorX& angles);

// G2_NOT_MET with the fixed vertices where a curvature was asked for and the surface is only tangent. Figures:
// "vertices", "outline_vertices", and why: "smooth_share" (how much of the curvature lacking is smooth; below 1/3:
// noise), or 1 for "not_found", "proxy_mesh" or "no_tangent_join"; none where the curvature is not known.
void warn_of_join(const Patch& patch, const Solution& solution, Diagnostics& warnings);

// PINS_NOT_SPREAD with the pins that act in a point although a radius was asked for. Another one, with the figure
// "tips", names those at which the surface forms a spike (pins/spread_pins).
void warn_of_pins(const Patch& patch, const Solution& solution, Diagnostics& warnings);
// NO_SOLUTION: another surface was taken instead, with the free vertices. Figures: "free_vertices"; "harmonic", 1, for
// that equation; "loft", "smoothed" or "bilaplacian", 1, for a loft, the old shape or the first surface; "kinks", the
// number of boundary vertices where one of these leaves the tangent planes by more than 20°; they are the elements
// then; for a low-passed boundary (method/proxy_surface) "distance", how far it lies beside the surface, in units of D.
Diagnostic no_solution(const Problem& problem, const Solution& solution);

// Triangles of a patch by the numbers that the caller knows, ascending.
Indices input_numbers(const Patch& patch, Indices triangles);

// FLIPPED_TRIANGLES and SELF_INTERSECTION, with these triangles (the caller's numbers), where there are some.
void warn_of_folds(Indices flipped, Indices crossing, Diagnostics& warnings);

// Diagnostics of a solved patch: flipped and crossing triangles, and a boundary that turns more than 20° from vertex to
// vertex.
void diagnose(const Patch& patch, const Solution& solution, const Points& prescribed, Diagnostics& warnings);

}  // namespace fairing
