// A mesh of the same surface with short edges along chosen sides, and longer ones away from them.
#pragma once

#include "base/types.h"

namespace fairing {

// True where a side of a triangle (3 × m; side k runs from corner k to the next) is one of those chosen.
using ChosenSides = Eigen::Array<bool, 3, Eigen::Dynamic>;

struct GradedMesh {
    Points points;        // the given ones come first
    Triangles triangles;  // wound as the triangles that they lie in
    Indices parent;       // the triangle given that each lies in
    Points weights;       // 3 × 3 s: barycentric in the parent, corner after corner
    ChosenSides chosen;
};

// Halves edges until none is longer than `finest`, a length, or than a quarter of its distance to the chosen sides
// along edges, whichever is more: what a harmonic function has of waves as short as an edge has died away there. The
// surface does not change, and neighbours keep whole edges in common, whatever their winding and number. Precondition:
// finest > 0. Throws Cancelled.
GradedMesh graded_mesh(const Points& points, const Triangles& triangles, const ChosenSides& chosen, double finest);

}  // namespace fairing
