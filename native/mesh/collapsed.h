// Triangles that name a vertex twice.
#pragma once

#include "base/types.h"

namespace fairing {

// The others, in their order.
Triangles without_collapsed(const Triangles& triangles);

}  // namespace fairing
