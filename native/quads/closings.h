// Positions of irregular vertices for which the open part becomes a part of a plane grid.
#pragma once

#include "quads/front.h"

namespace fairing {

// Kinds of poles, in the order in which the walk meets them.
enum class PoleKind { three, five, triangle };

struct Closing {
    std::vector<Pole> poles;  // and corners that the boundary gets or loses: those at its own vertices
    double misfit = 0.0;      // share of the variance that no rotated and scaled lattice polygon explains, 0 … 1,
                              // and the costs of the boundary's turns over the number of quads
    int cell_count = 0;       // of the grid that remains
};

// The `count` best closings by misfit: positions at which poles of these kinds close the walk to a simple lattice
// polygon. A pole turns all that follows by 90°, so the walk's end is a sum with one term for each pole: poles before
// the last two are tried at some positions, the last two are looked up.
std::vector<Closing> closings(const QuadFront& front, const std::vector<PoleKind>& kinds, int count);

}  // namespace fairing
