// A patch whose isolated pins are numbered among the free vertices.
#pragma once

#include "mesh/patch.h"

namespace fairing {

struct Released {
    Patch patch;
    Indices from;  // vertex of `patch` → vertex of the given one; free vertices keep their numbers
    Indices to;    // and back
};

// `pins`: places among the fixed vertices. They come right after the free ones, in their order.
Released released(const Patch& given, const Indices& pins);

}  // namespace fairing
