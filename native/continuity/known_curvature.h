// Where on a boundary the curvature is known.
#pragma once

#include "continuity/outline_modes.h"

namespace fairing {

struct KnownCurvature {
    VectorX values;                    // H at the fixed vertices, 0 off the curves
    std::vector<OutlineCurve> curves;  // whole loops, or arcs between vertices without a known curvature
    Indices unknown;  // boundary vertices off the curves that ask for it, counted from the first fixed one; ascending

    // What H at the fixed vertices lacks, zero off the curves.
    [[nodiscard]] VectorX missing(const VectorX& curvatures) const;
};

// `curvatures`: H at each fixed vertex, NaN where it is not known, infinite where it is not asked for. Gaps of up to
// three unknown ones are bridged by interpolation; arcs of less than six vertices count as unknown. Pins don't count at
// all. Corners of the patch, where it fills less than 120°, are skipped: H answers to the wedge there as much as to the
// surface, and on boundaries that run in steps it alternates from vertex to vertex. `points`: 3 × local vertices of a
// surface over the boundary.
KnownCurvature known_curvature(const Patch& patch, const Points& points, const VectorX& curvatures);

}  // namespace fairing
