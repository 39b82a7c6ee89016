// Normals from surfaces fitted to nearby points: for outlines, where the one-ring sees one side only.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Normals at the fixed vertices (3 × fixed count) fitted to the patch's own side of the outline; averaged ones where
// the fit has too few points.
Points one_sided_normals(const Patch& patch, const Points& points);

struct SurroundingNormals {
    Points normals;            // 3 × k, unit; zero where there is no triangle
    std::vector<char> fitted;  // 0: averaged, for want of points
};

// Normals at `vertices` of the surface formed by `triangles` alone (the surroundings of a patch).
SurroundingNormals surrounding_normals(const Points& points, const Triangles& triangles, const Indices& vertices);

}  // namespace fairing
