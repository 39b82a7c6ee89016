// Inner fairness: how vertices sit in the surface (paper §7.3).
#pragma once

#include <optional>

#include "mesh/patch.h"

namespace fairing {

enum class InnerFairness { uniform, conformal, inverse_distance, custom };

// λ of two local vertices, the same in both directions.
struct WeightedEdge {
    int i;
    int j;
    double weight;
};

using InnerWeights = std::vector<WeightedEdge>;

// λ of a patch. None: 1 on its edges, listed only on demand: they would take too much memory on a large patch.
using Lambda = std::optional<InnerWeights>;

// Whether all edges have the same weight.
bool is_uniform(const Lambda& weights);

// λ = 1 on the edges of the patch.
InnerWeights uniform_weights(const Patch& patch);

// λ = 1 on the given edges (local vertices), whatever the triangulation.
InnerWeights uniform_weights(const std::vector<std::array<int, 2>>& edges);

// λ = cot α + cot β of the reference positions (3 × local vertices): the discrete conformal weights of M0. They
// belong to the intrinsic Delaunay triangulation of M0, so that none of them is negative.
InnerWeights conformal_weights(const Patch& patch, const Points& reference);

// use(edges) of λ.
template <typename Use>
auto with_edges(const Patch& patch, const Lambda& weights, const Use& use) {
    return weights ? use(*weights) : use(uniform_weights(patch));
}

}  // namespace fairing
