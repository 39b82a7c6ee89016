// A piece of skin to copy from.
#pragma once

#include <optional>

#include "base/progress.h"
#include "mesh/patch.h"

namespace fairing {

// Heights over a smooth base, in the caller's unit.
struct SkinSample {
    Points base;
    Points normals;   // unit, of the base
    VectorX heights;  // of the old surface along them
    VectorX depth;    // distance from the edge of the sample
    Triangles triangles;
    double edge = 0.0;  // mean length of the base's edges
};

// The heights of a patch (3 × local vertices) without what is longer than `wavelength`, a length. Nothing where its
// triangles have no area. Throws Cancelled.
std::optional<SkinSample> sample_of(const Patch& patch, const Points& points, double wavelength,
                                    const Progress& progress);

}  // namespace fairing
