// Patterns of quads over a tube between two boundary loops.
#pragma once

#include "quads/candidates.h"

namespace fairing {

// Interior angles in degrees at the vertices of both loops, each in the direction that has the surface on its left.
// Their first vertices face each other.
struct TubeBoundary {
    VectorX first_angles;
    VectorX second_angles;
    double length = 0.0;  // from loop to loop, in edges of the boundary
    double cells = 0.0;   // how many squares of these edges the surface has room for
};

// At most `count`. The tube is cut along a seam from the first loop's first vertex to a vertex near the second's; what
// that leaves is a hole. The pattern's boundary is the first loop, then the second.
std::vector<CandidatePattern> tube_patterns(const TubeBoundary& tube, int count);

}  // namespace fairing
