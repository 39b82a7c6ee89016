// The surface whose normal curvatures vary least.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Minimises ∫ ⟨(dκ/ds)²⟩ dA · ∫ dA (variation/element.h; the product keeps its value when everything is scaled) with
// the boundary's positions and normals. Solved on a mesh of the engine's own, whose vertices and normals are the
// unknowns; the patch's vertices are projected onto that surface by their inner fairness. The interior given is not
// read. The solution's `termination` and `residual` (largest derivative of the product by a height, in units of D) are
// of this problem; `polished` is false. Deterministic. Throws Cancelled, SolverError.
Solution solve_least_variation(const Problem& problem, const Progress& progress);

// A surface near the one sought: 3 × local vertices of the problem's patch, of good triangles.
struct NearVariation {
    Points points;
    bool roughly;  // a coarse mesh is enough: the caller solves again from its result
};

struct VariationLimits {
    double most_product = HUGE_VAL;                    // returns nothing where the product is larger on a coarse mesh
    std::optional<NearVariation> near = std::nullopt;  // where to begin
};

// The same within limits.
std::optional<Solution> solve_less_varying(const Problem& problem, const VariationLimits& limits,
                                           const Progress& progress);

}  // namespace fairing
