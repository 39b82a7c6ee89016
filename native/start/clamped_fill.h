// Clamped fills of the boundary, which depend on connectivity and boundary data only.
#pragma once

#include "base/progress.h"
#include "geometry/face_geometry.h"
#include "operators/normal_operator.h"
#include "problem/problem.h"

namespace fairing {

// S and M of a mesh whose triangles are all equilateral (edge weight 2/√3, half of it on the border).
Stiffness uniform_stiffness(const Patch& patch);

// A field (3 × local vertices) whose fixed values stay and whose free ones are harmonic on such triangles. Nothing
// where there is no factor.
std::optional<Points> harmonic_between(const Patch& patch, Points field, const Progress& progress);

// Clamped bi-Laplacian membranes over the boundary: linear in the conormals, whose weight sigma decides how far the
// surface bulges. positions(sigma) = flat + sigma · bulge, free vertices only.
struct Fill {
    Points flat;
    Points bulge;
};

// `op`: biharmonic; it keeps the factorisation for `stiffness`.
Fill clamped_fill(const Patch& patch, const Stiffness& stiffness, const Points& fixed_points, const Points& conormals,
                  NormalOperator& op, const Progress& progress);
// Displacement of the free vertices that continues one of the fixed vertices and the change of their conormals
// (3 × fixed count) as smoothly. `op` holds the factorisation for `stiffness`.
Points clamped_displacement(const Patch& patch, const Stiffness& stiffness, const Points& fixed_displacement,
                            const Points& conormal_change, const NormalOperator& op);
// With the uniform stiffness.
Fill clamped_fill(const Patch& patch, const Points& fixed_points, const Points& conormals, NormalOperator& op,
                  const Progress& progress);

// The discrete harmonic map of the boundary by the inner-fairness weights (3 × local vertices).
Points membrane(const Problem& problem, const Workspace& work);

// Repeats x ← the harmonic map from the last surface (Pinkall & Polthier 1993), which never increases the area.
Points descend_area(const Problem& problem, Workspace& work, const Points& start, const Progress& progress);

// The fill of the boundary with the least Willmore energy among a few bulges (3 × local vertices).
Points best_fill(const Problem& problem, Workspace& work, const Progress& progress);

}  // namespace fairing
