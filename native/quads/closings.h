// Where poles have to lie so that what is open becomes a part of a plane grid.
#pragma once

#include "quads/front.h"

namespace fairing {

// Kinds of poles, in the order in which the walk meets them.
enum class PoleKind { three, five, triangle };

struct Closing {
    std::vector<Pole> poles;  // and corners that the boundary gets or loses: those at its own vertices
    double misfit = 0.0;      // share of the places' spread that no turned and scaled lattice polygon explains, 0 … 1,
                              // and the costs of the boundary's turns over the number of quads
    int cell_count = 0;       // of the grid that remains
};

// The `count` best places, by their misfit, at which poles of these kinds close the walk to a simple lattice polygon.
// Each turns all that follows by a quarter, so that the end of the walk is a sum with one
// term for each pole: those before the last two are tried at some places, the last two are looked up.
std::vector<Closing> closings(const QuadFront& front, const std::vector<PoleKind>& kinds, int count);

}  // namespace fairing
