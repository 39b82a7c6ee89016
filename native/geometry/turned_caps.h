// Triangles without area that have a vertex over their longest side, as booleans leave them.
#pragma once

#include <array>
#include <vector>

#include "base/types.h"

namespace fairing {

// What stood in a triangle list before and after: `cap` became, with the triangle `beside` over its longest side, two
// triangles of that one's plane. `ends` of that side, which is no more, and the vertex `over` it, that parts it now.
struct TurnedCap {
    int cap, beside;
    std::array<int, 2> ends;
    int over;
};

// Turns the longest side of each triangle marked in `may_turn` that is lower over it than `least`, or than 1e-5 of it,
// while its sides are longer; the triangle beside has to be marked in `may_take`. In the order in which they were
// turned: a side with several vertices over it is parted by one after the other.
std::vector<TurnedCap> turn_caps(const Points& points, const std::vector<char>& may_turn,
                                 const std::vector<char>& may_take, double least, Triangles& triangles);

}  // namespace fairing
