// A surface over a boundary that knows nothing of slopes: where a patch leads from there.
#pragma once

#include "base/types.h"

namespace fairing {

// Every vertex of the triangles that is not held at the mean of its neighbours, nearly: discs over flat loops are flat.
// Places of vertices without triangles stay.
Points closing_surface(const Points& points, const Triangles& triangles, const std::vector<char>& held);

}  // namespace fairing
