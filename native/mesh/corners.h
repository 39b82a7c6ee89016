// From triangles of a patch to their corners and back.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Each once, ascending.
Indices corners_of(const Patch& patch, const Indices& triangles);

// Those with one of the vertices as a corner; each once, ascending.
Indices triangles_at(const Patch& patch, const Indices& vertices);

bool has_free_corner(const Patch& patch, int triangle);

// Those of some triangles that have one of the vertices, in their order.
Indices with_free_corner(const Patch& patch, Indices triangles);

}  // namespace fairing
