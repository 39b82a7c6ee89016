// Where on an outline the curvature is known.
#pragma once

#include "continuity/outline_modes.h"

namespace fairing {

struct KnownCurvature {
    VectorX values;                    // H at the fixed vertices, 0 off the curves
    std::vector<OutlineCurve> curves;  // whole loops, or arcs between vertices without a known curvature
    Indices unknown;                   // outline vertices off the curves, counted from the first fixed one; ascending
    std::vector<char> corner;          // of the fixed vertices: the patch fills less than 120° there

    // What H at the fixed vertices lacks, zero off the curves. At corners H answers to the wedge as much as to the
    // surface: on outlines like stairs it alternates from vertex to vertex. The lack there is interpolated.
    [[nodiscard]] VectorX missing(const VectorX& curvatures) const;
};

// `curvatures`: H at each fixed vertex, NaN where it is not known. Gaps of up to three vertices are bridged by
// interpolation; arcs of less than six vertices count as unknown. Pins don't count at all. `points`: 3 × local vertices
// of a surface over the outline.
KnownCurvature known_curvature(const Patch& patch, const Points& points, const VectorX& curvatures);

}  // namespace fairing
