// Triangles without a height.
#pragma once

#include "base/types.h"

namespace fairing {

struct Needles {
    Indices all;   // triangles whose height is below `needle_height` of their longest side; ascending
    Indices seen;  // those between neighbours that bend by more than `flat_bend`: on a plane no one sees them
                   // (shape/limits)
};

// Of any triangles; a corner that isn't finite makes one.
Needles needles(const Points& points, const Triangles& triangles);

}  // namespace fairing
