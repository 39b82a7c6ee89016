// Where on an outline the curvature is known.
#pragma once

#include "continuity/outline_modes.h"

namespace fairing {

struct KnownCurvature {
    VectorX values;                    // H at the fixed vertices, 0 off the curves
    std::vector<OutlineCurve> curves;  // whole loops, or arcs between vertices without a known curvature
    Indices unknown;                   // outline vertices off the curves, counted from the first fixed one; ascending
};

// `curvatures`: H at each fixed vertex, NaN where it is not known. Gaps of up to three vertices are bridged by
// interpolation; arcs of less than six vertices count as unknown. Pins don't count at all.
KnownCurvature known_curvature(const Patch& patch, const VectorX& curvatures);

}  // namespace fairing
