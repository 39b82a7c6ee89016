#include <doctest/doctest.h>

#include <chrono>
#include <set>
#include <thread>

#include "base/errors.h"
#include "fairness/intrinsic_delaunay.h"
#include "fairness/ring_weights.h"
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

// Whether `work` asks, when it is due, to go on.
template <typename Work>
bool asks(const Work& work) {
    const Progress progress([](double, std::string_view) { return false; });
    const Checkpoints checkpoints(progress);
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    try {
        work();
    } catch (const Cancelled&) {
        return true;
    }
    return false;
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

TEST_CASE("the harmonic positions are balanced in all coordinates") {
    const test::Single single = test::single_patch(test::grid(8, 0.3, test::sphere));
    const Patch& patch = single.patch();
    const InnerWeights weights = uniform_weights(patch);
    const Points fixed = single.points.rightCols(patch.vertex_count() - patch.free_count);
    const auto step = make_tangential_step(patch, weights, fixed, Progress());
    Points x(3, patch.vertex_count());
    x << step->harmonic_positions(), fixed;
    CHECK(imbalance(patch, weights, x).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("tangential displacements stay across the normals and lead to balance on a plane") {
    const test::Single single = test::single_patch(test::grid(8, 0.3, test::flat));
    const Patch& patch = single.patch();
    const InnerWeights weights = uniform_weights(patch);
    const auto step = make_tangential_step(
        patch, weights, single.points.rightCols(patch.vertex_count() - patch.free_count), Progress());
    Points x = single.points;
    const Points normals = Vector3::UnitZ().replicate(1, patch.vertex_count());
    for (int k = 0; k < 12; ++k) {
        const Points d = step->displacement(x, normals);
        CHECK(d.row(2).cwiseAbs().maxCoeff() < 1e-15);
        x.leftCols(patch.free_count) += d;
    }
    CHECK(imbalance(patch, weights, x).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("weights can be cancelled while they are made") {
    const test::Single single = test::single_patch(test::grid(8, 0.2, test::sphere));
    IntrinsicTriangulation triangulation(single.patch().triangles, single.points);
    CHECK(asks([&] { triangulation.make_delaunay(); }));
    CHECK(asks([&] { (void)triangulation.cotangent_weights(); }));
    CHECK(asks([&] { row_weights(single.patch(), single.points, InnerFairness::inverse_distance); }));
    CHECK(asks([&] { row_weights(single.patch(), uniform_weights(single.patch()), "x"); }));
}
