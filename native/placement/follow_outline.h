// Rows of vertices beside a boundary that lies off the surface.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// The three rows next to the boundary move half as far as the mean of what they touch in the row before. `offsets`: of
// the fixed vertices from the surface, 3 × fixed count; `points`: 3 × local vertices on it, the fixed ones leave it.
// Vertices stay where triangles between free ones would turn over.
void follow_outline(const Patch& patch, const Points& offsets, Points& points);

}  // namespace fairing
