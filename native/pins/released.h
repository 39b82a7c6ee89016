// A patch whose isolated pins are numbered among the free vertices.
#pragma once

#include "problem/problem.h"

namespace fairing {

struct Released {
    Patch patch;
    Indices from;  // vertex of `patch` → vertex of the given one; free vertices keep their numbers
    Indices to;    // and back
};

// `pins`: places among the fixed vertices. They come right after the free ones, in their order.
Released released(const Patch& given, const Indices& pins);

// The problem without these pins, with uniform weights. `free` must outlive it.
Problem on_released(const Problem& problem, const Released& free);

}  // namespace fairing
