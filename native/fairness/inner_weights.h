// Inner fairness: how vertices sit in the surface (paper §7.3).
#pragma once

#include "mesh/patch.h"

namespace fairing {

enum class InnerFairness { uniform, conformal, inverse_distance, shape_preserving, custom };

// λ of two local vertices, the same in both directions.
struct WeightedEdge {
    int i;
    int j;
    double weight;
};

using InnerWeights = std::vector<WeightedEdge>;

// λ = 1 on the edges of the patch.
InnerWeights uniform_weights(const Patch& patch);

// λ = 1 on the given edges (local vertices), whatever the triangulation.
InnerWeights uniform_weights(const std::vector<std::array<int, 2>>& edges);

// λ = cot α + cot β of the reference positions (3 × local vertices): the discrete conformal weights of M0. They
// belong to the intrinsic Delaunay triangulation of M0, so that none of them is negative.
InnerWeights conformal_weights(const Patch& patch, const Points& reference);

}  // namespace fairing
