// A surface over a boundary that knows nothing of slopes: where a patch leads from there.
#pragma once

#include "base/types.h"

namespace fairing {

// Every vertex of the triangles that is not held at the mean of its neighbours: discs over flat loops are flat.
// Vertices that hang together with no held one stay.
Points closing_surface(const Points& points, const Triangles& triangles, const std::vector<char>& held);

}  // namespace fairing
