// How chains of edges run on.
#pragma once

#include "base/types.h"

namespace fairing {

// Beyond its first vertex.
struct ChainEnd {
    Vector3 direction;  // unit, out of the chain
    Vector3 curvature;  // of the circle, to its centre, length⁻¹; zero where two vertices are known
};

// The circle through the first column that fits the others best. Exact on circles and straight lines.
// Precondition: two different columns or more, all different from the first.
ChainEnd end_of_chain(const Points& chain);

}  // namespace fairing
