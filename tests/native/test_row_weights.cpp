#include <doctest/doctest.h>

#include <stdexcept>

#include "fairness/row_weights.h"
#include "meshes.h"

using namespace fairing;

namespace {

const InnerFairness all_kinds[] = {InnerFairness::uniform, InnerFairness::conformal, InnerFairness::inverse_distance,
                                   InnerFairness::shape_preserving};

// Largest distance of a vertex from its weighted mean.
double largest_defect(const test::Single& single, InnerFairness kind) {
    const RowWeights rows = row_weights(single.patch(), single.points, kind);
    double largest = 0.0;
    for (int i = 0; i < single.patch().free_count; ++i) {
        largest = std::max(largest, (rows.mean(i, single.points) - single.points.col(i)).norm());
    }
    return largest;
}

}  // namespace

TEST_CASE("every row of weights is a convex combination") {
    // Sheared, so that many cotangent weights of the stored triangles are negative, and bent.
    const test::Single single =
        test::single_patch(test::grid(8, 0.3, [](double u, double v) { return Vector3(u + 1.5 * v, v, 0.4 * u * v); }));
    for (const InnerFairness kind : all_kinds) {
        const RowWeights rows = row_weights(single.patch(), single.points, kind);
        for (int i = 0; i < single.patch().free_count; ++i) {
            double sum = 0.0;
            for (double w : rows.values_of(i)) {
                CHECK(w >= 0.0);
                sum += w;
            }
            CHECK(sum == doctest::Approx(1.0));
        }
    }
}

TEST_CASE("shape-preserving weights reproduce planar meshes with negative cotangents too") {
    const test::Single single =
        test::single_patch(test::grid(8, 0.2, [](double u, double v) { return Vector3(u + 2.5 * v, v, 0.0); }));
    CHECK(largest_defect(single, InnerFairness::shape_preserving) < 1e-13);
}

TEST_CASE("custom rows are normalised, and a free vertex without one is refused") {
    const test::Single single = test::single_patch(test::grid(3, 0.0, test::flat));
    std::vector<DirectedWeight> weights;
    for (int i = 0; i < single.patch().free_count; ++i) weights.insert(weights.end(), {{i, 9, 1.0}, {i, 10, 3.0}});
    const RowWeights rows = row_weights(single.patch(), weights, "inner_fairness");
    CHECK(rows.values_of(1)[1] == doctest::Approx(0.75));
    weights.pop_back();
    weights.pop_back();
    CHECK_THROWS_AS(row_weights(single.patch(), weights, "inner_fairness"), std::invalid_argument);
}
