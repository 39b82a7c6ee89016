// Patterns of quads over a boundary, those that suit it best first.
#pragma once

#include "quads/front.h"

namespace fairing {

// A hole's boundary: interior angles of its surface in degrees, and roughly where it lies in a plane without crossing
// itself.
struct HoleBoundary {
    VectorX angles;
    Eigen::Matrix2Xd places;
    double cells = 0.0;  // how many squares of the boundary's edges the surface has room for
};

// A pattern with what speaks against it: `misfit` of its shape and size, from 0.
struct CandidatePattern {
    QuadPattern pattern;
    double misfit = 0.0;
    int poles = 0;
    int least_poles = 0;  // that the corners of the boundary require
};

// At most `count`. Corners are vertices whose angles are nearer to 90°, 270° or 360° than to 180°; as a corner may be
// rounded off, patterns are also tried with more and more corners taken as straight.
std::vector<CandidatePattern> candidate_patterns(const HoleBoundary& boundary, int count);

// The same for corners that are known: `faces` of the new quads at each vertex of the boundary.
std::vector<CandidatePattern> patterns_with_corners(const HoleBoundary& boundary, const Indices& faces, int count);

}  // namespace fairing
