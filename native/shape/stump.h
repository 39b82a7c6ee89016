// Stumps: where a surface bends over at its boundary while its surroundings bend back, since the boundary runs over the
// root of what was to go.
#pragma once

#include "base/types.h"

namespace fairing {

struct Stump {
    double degrees = 0.0;  // by which both bend, the lesser of them: the mean along the boundary, 0 where they run on
    Indices vertices;      // of the boundary where it is more than `stump` (shape/limits), ascending
};

// Of triangles in one numbering, those outside at least as far as half the surface's radius, all wound alike. In O(1),
// but for a look at each triangle: of many it samples some.
Stump stump_of(const Points& points, const Triangles& inside, const Triangles& outside);

}  // namespace fairing
