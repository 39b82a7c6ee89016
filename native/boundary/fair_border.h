// Open borders as fair curves.
#pragma once

#include "base/types.h"

namespace fairing {

// Smooths the runs of marked vertices along one loop. `loop`: columns of `points`, in their order around; a run ends at
// the vertices beside it, which stay. The curve minimises Σ |Δ³x|² + μ Σ |x − given|²: how its curvature varies (third
// derivative), against how far it moves. μ is found by generalised cross-validation (Craven & Wahba 1979), so that
// noise goes and a shape of many vertices stays. Runs shorter than 6 stay as they are.
void fair_border(const Indices& loop, const std::vector<char>& marked, Points& points);

// How a chain of vertices goes on beyond its first one.
struct ChainEnd {
    Vector3 direction;  // unit, out of the chain
    Vector3 curvature;  // of the circle, to its centre, length⁻¹; zero where the chain has only two vertices
};

// The circle through the first column that fits the others best. Exact on circles and straight lines.
// Precondition: two different columns or more, all different from the first.
ChainEnd end_of_chain(const Points& chain);

}  // namespace fairing
