#include "fairness/inner_weights.h"

#include "fairness/intrinsic_delaunay.h"

namespace fairing {

InnerWeights uniform_weights(const std::vector<std::array<int, 2>>& edges) {
    InnerWeights weights;
    weights.reserve(edges.size());
    for (const auto& [i, j] : edges) weights.push_back({i, j, 1.0});
    return weights;
}

InnerWeights uniform_weights(const Patch& patch) { return uniform_weights(patch.edge_ends); }

bool is_uniform(const Lambda& weights) {
    return !weights || std::all_of(weights->begin(), weights->end(),
                                   [&](const WeightedEdge& edge) { return edge.weight == weights->front().weight; });
}

InnerWeights conformal_weights(const Patch& patch, const Points& reference) {
    IntrinsicTriangulation triangulation(patch.triangles, reference);
    triangulation.make_delaunay();
    return triangulation.cotangent_weights();
}

}  // namespace fairing
