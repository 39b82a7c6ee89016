#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include <Eigen/QR>

#include "base/parallel.h"
#include "linear/nested_dissection.h"
#include "linear/sparse_cholesky.h"
#include "meshes.h"
#include "method/levels.h"
#include "method/plan.h"
#include "multigrid/coarsening.h"
#include "multigrid/tangential_multigrid.h"
#include "operators/normal_operator.h"
#include "problem/surface_state.h"
#include "tangential/symmetric_step.h"

using namespace fairing;

namespace {

// A part of the unit sphere, where points are their own normals, with its levels.
struct Ball {
    explicit Ball(int n, double jitter = 0.3, int coarsest = 40,
                  const std::function<Vector3(double, double)>& surface = test::sphere)
        : single(test::single_patch(test::grid(n, jitter, surface))),
          weights(uniform_weights(single.patch())),
          levels(coarsen(single.patch(), weights, {single.points, single.points}, coarsest)) {}

    [[nodiscard]] const Patch& patch() const { return single.patch(); }
    [[nodiscard]] Points fixed_points() const {
        return single.points.rightCols(patch().vertex_count() - patch().free_count);
    }

    test::Single single;
    InnerWeights weights;
    std::vector<CoarseLevel> levels;
};

Points of_level(const CoarseLevel& level, const Points& finest) {
    Points result(3, level.patch.vertex_count());
    for (int v = 0; v < level.patch.vertex_count(); ++v) result.col(v) = finest.col(level.patch.to_input[v]);
    return result;
}

}  // namespace

TEST_CASE("levels are the same for any number of threads") {
    const Ball alone(160);
    for (int times = 0; times < 5; ++times) {
        const Threads threads(4);
        const Ball together(160);
        REQUIRE(together.levels.size() == alone.levels.size());
        for (std::size_t k = 0; k < alone.levels.size(); ++k) {
            CHECK(together.levels[k].patch.triangles == alone.levels[k].patch.triangles);
            CHECK(together.levels[k].transfer.removals.weights == alone.levels[k].transfer.removals.weights);
        }
    }
}

TEST_CASE("restriction is the transpose of interpolation, whose weights sum to one") {
    const Ball ball(30);
    const Transfer& transfer = ball.levels.front().transfer;
    for (int k = 0; k < transfer.removals.size(); ++k) {
        const auto first = transfer.removals.weights.begin() + transfer.removals.begin[k];
        const auto last = transfer.removals.weights.begin() + transfer.removals.begin[k + 1];
        CHECK(std::accumulate(first, last, 0.0) == doctest::Approx(1.0).epsilon(1e-6));
    }
    SingleField coarse = SingleField::Random(4, ball.levels.front().patch.vertex_count());
    coarse.rightCols(coarse.cols() - transfer.coarse_free_count).setZero();
    SingleField fine = SingleField::Random(4, transfer.fine_count);
    SingleField prolonged(4, transfer.fine_count);
    transfer.prolong(coarse, prolonged);
    const double left = prolonged.cwiseProduct(fine).cast<double>().sum();
    SingleField restricted(4, coarse.cols());
    SingleField sums(4, transfer.fine_count);
    Restriction(transfer).apply(fine, 1.0F, sums, restricted);
    const double right = coarse.cwiseProduct(restricted).cast<double>().sum();
    CHECK(left == doctest::Approx(right).epsilon(1e-5));
}

TEST_CASE("multigrid and a factorisation give the same tangential steps") {
    const Ball ball(40, 0.3, 60);
    REQUIRE(ball.levels.size() >= 2);
    std::vector<Points> fixed;
    for (const CoarseLevel& level : ball.levels) {
        const Points all = of_level(level, ball.single.points);
        fixed.emplace_back(all.rightCols(level.patch.vertex_count() - level.patch.free_count));
    }
    const CoarseLevel& middle = ball.levels[0];
    const CoarseLevel& coarsest = ball.levels[1];
    const FactorisedLaplacian base(coarsest.patch, coarsest.weights, fixed[1], Progress());
    const MultigridStep between(middle.patch, RingMatrix(middle.patch.vertex_count(), middle.weights), fixed[0],
                                Restriction(coarsest.transfer), base);
    const MultigridStep multigrid(ball.patch(), RingMatrix(ball.patch().vertex_count(), ball.weights),
                                  ball.fixed_points(), Restriction(middle.transfer), between);
    const SymmetricStep factorised(ball.patch(), ball.weights, ball.fixed_points(), Progress());

    const Points membrane = factorised.harmonic_positions();
    CHECK((multigrid.harmonic_positions() - membrane).norm() < 1e-6 * membrane.norm());
    const Points step = factorised.displacement(ball.single.points, ball.single.points, {0.05, 30});
    const Points other = multigrid.displacement(ball.single.points, ball.single.points, {0.05, 30});
    // Both stop at a residual of 0.05.
    CHECK((step - other).norm() < 0.15 * step.norm());
    CHECK(multigrid.merit(ball.single.points) > 0.0);  // and both measure the energy that steps lower
}

TEST_CASE("nested dissection is an order of elimination with less fill than the natural one") {
    const test::Single single = test::single_patch(test::grid(90, 0.3, test::flat));
    const Patch& patch = single.patch();
    SparseMatrix lower(patch.free_count, patch.free_count);
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < patch.free_count; ++i) {
        entries.emplace_back(i, i, 7.0);
        for (const int j : patch.ring(i).vertices) {
            if (patch.is_free(j) && j > i) entries.emplace_back(j, i, -1.0);
        }
    }
    lower.setFromTriplets(entries.begin(), entries.end());
    const Points layout = single.points.leftCols(patch.free_count);
    const Indices order = nested_dissection(lower, layout);
    Indices sorted = order;
    std::sort(sorted.begin(), sorted.end());
    Indices natural(order.size());
    std::iota(natural.begin(), natural.end(), 0);
    CHECK(sorted == natural);
    const auto fill = [&](const Indices& first_order) {
        const Supernodes nodes = analyse(lower, first_order).supernodes;
        double count = 0.0;
        for (int k = 0; k < nodes.size(); ++k) count += static_cast<double>(nodes.row_count(k)) * nodes.column_count(k);
        return count;
    };
    CHECK(fill(order) < 0.6 * fill(natural));

    SparseCholesky factor(layout);
    REQUIRE(factor.factorise(lower, "a test matrix", Progress()));
    const Eigen::MatrixXd rhs = Eigen::MatrixXd::Random(patch.free_count, 2);
    const Eigen::MatrixXd residual = lower.selfadjointView<Eigen::Lower>() * factor.solve(rhs) - rhs;
    CHECK(residual.norm() < 1e-11 * rhs.norm());
}
