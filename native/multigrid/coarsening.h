// The levels of the global method's multigrid: the user's connectivity, ever coarser.
#pragma once

#include "multigrid/transfer.h"

namespace fairing {

// A level below the finest.
struct CoarseLevel {
    Patch patch;           // to_input: vertices of the finest patch
    InnerWeights weights;  // local vertices
    Transfer transfer;     // to the next finer level
};

// Fine to coarse, each about a quarter of the one before, down to about `coarsest` free vertices; fewer levels where no
// collapse is left.
std::vector<CoarseLevel> coarsen(const Patch& patch, const InnerWeights& weights, const FixedPlaces& boundary,
                                 int coarsest);

// By connectivity and λ alone, the interior given leaves no trace: with all fixed vertices on every level, down to
// about as many free ones.
std::vector<CoarseLevel> coarsen(const Patch& patch, const InnerWeights& weights);

}  // namespace fairing
