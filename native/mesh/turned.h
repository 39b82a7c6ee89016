// Triangles that are wound against the others.
#pragma once

#include "base/types.h"

namespace fairing {

// Triangles that are wound against most of those which edges of two triangles connect them with; ascending. None in a
// piece that has one side only. Precondition: as for make_edges.
Indices turned_triangles(const Triangles& triangles, int vertex_count);

}  // namespace fairing
