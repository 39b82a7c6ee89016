// Boundaries on the flank of a bump or a dent: the surface continues that slope, so that the feature stays.
//
// All around such a boundary the patch bends over to one side, and its surroundings bend back to the other. Around
// whole features they run on, or bend to both sides.
#pragma once

#include "mesh/patch.h"

namespace fairing {

struct Flank {
    Indices boundary;      // vertices
    bool is_bump = false;  // or a dent
    double width = 0.0;    // from the boundary to the flank's end
};

// Triangles around a patch, wound as it is, as far as the patch is wide.
struct Around {
    Points points;
    Triangles triangles;
};

// Of a surface (3 × local vertices) that continues the slope of its surroundings. Nothing where the patch is no disc or
// has pins.
std::optional<Flank> flank_of(const Patch& patch, const Points& points, const Around& around);

}  // namespace fairing
