// How thin and how thick a surface is between its boundary loops.
#pragma once

#include <optional>

#include "mesh/patch.h"

namespace fairing {

// The radius of the thinnest cross-section over that of the thinner of its two ends, and that of the thickest over the
// thicker end's: 1 and 1 or nearly so for tubes and cones, less than 1 for waists, more than 1 for balloons
// and where arms meet (1.3 in a star of three equal ones). A
// cross-section around a boundary loop is a level line of a function that is about harmonic on equilateral triangles, 1
// on that loop and 0 on all others; one of its ends is that loop, the other one are all others together. Its radius is
// that of the circle with the same area, which is the area of its shadow in the direction in which that is largest:
// steps and noise of the mesh hardly add to it, as they do to a length.
struct GirthRange {
    double least = 1.0;
    double largest = 1.0;
};

// Of a surface (3 × local vertices) with these normals at its fixed vertices, around all of its boundary loops. Nothing
// with fewer than two, nor where one is no tube's end (start/swept_tube). O(vertices).
std::optional<GirthRange> girth_range(const Patch& patch, const Points& points, const Points& fixed_normals);

// The worse of both sides.
GirthRange worst_of(const GirthRange& a, const GirthRange& b);

}  // namespace fairing
