#include <doctest/doctest.h>

#include "fairness/intrinsic_delaunay.h"
#include "fairness/row_weights.h"
#include "meshes.h"
#include "tangential/tangential_step.h"

using namespace fairing;

namespace {

// Σ_j λ_ij (x_i − x_j) at the free vertices.
Points imbalance(const Patch& patch, const InnerWeights& weights, const Points& x) {
    Points sum = Points::Zero(3, patch.vertex_count());
    for (const auto& [i, j, w] : weights) {
        sum.col(i) += w * (x.col(i) - x.col(j));
        sum.col(j) += w * (x.col(j) - x.col(i));
    }
    return sum.leftCols(patch.free_count);
}

}  // namespace

TEST_CASE("intrinsic Delaunay weights are not negative, and flips keep the area") {
    // Sheared so far that the stored triangles have negative weights.
    const test::Single single =
        test::single_patch(test::grid(8, 0.2, [](double u, double v) { return Vector3(u + 2.5 * v, v, 0.0); }));
    const InnerWeights weights = conformal_weights(single.patch(), single.points);
    for (const WeightedEdge& edge : weights) CHECK(edge.weight > 0.0);
    CHECK(imbalance(single.patch(), weights, single.points).cwiseAbs().maxCoeff() < 1e-5);
}
