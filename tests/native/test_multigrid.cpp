#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include <Eigen/QR>

#include "base/parallel.h"
#include "linear/nested_dissection.h"
#include "linear/sparse_cholesky.h"
#include "meshes.h"
#include "method/levels.h"
#include "method/traits.h"
#include "multigrid/coarsening.h"
#include "multigrid/tangential_multigrid.h"
#include "operators/normal_operator.h"
#include "problem/surface_state.h"
#include "tangential/symmetric_step.h"

using namespace fairing;

namespace {

int euler_number(const Patch& patch) { return patch.vertex_count() - patch.edge_count() + patch.triangle_count(); }

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

TEST_CASE("a level that was left has its edges and rings again when it comes back") {
    const Ball ball(60);
    const Points fixed = ball.fixed_points();
    const Problem problem{ball.patch(), fixed, fixed, ball.weights, {}};
    Levels levels(problem, Outlines::kept, coarsest_size);
    REQUIRE(levels.coarsest() >= 1);
    const Patch& patch = levels.problem(1).patch;
    const Patch before = patch;
    levels.leave(1);
    CHECK(patch.vertex_count() == before.vertex_count());
    CHECK(patch.free_count == before.free_count);
    CHECK(patch.edge_count() == 0);
    for (int times = 0; times < 2; ++times) {  // once more changes nothing
        levels.come_back(1);
        CHECK(patch.edge_ends == before.edge_ends);
        CHECK(patch.triangles == before.triangles);
        for (int v = 0; v < patch.vertex_count(); ++v)
            CHECK(std::ranges::equal(patch.ring(v).vertices, before.ring(v).vertices));
    }
}

TEST_CASE("outlines without normals stay whole on all levels") {
    const Ball ball(60);
    const Points unknown = Points::Zero(3, ball.patch().vertex_count());
    const auto levels = coarsen(ball.patch(), ball.weights, {ball.single.points, unknown}, 40);
    REQUIRE(!levels.empty());
    const int fixed = ball.patch().vertex_count() - ball.patch().free_count;
    for (const CoarseLevel& level : levels) CHECK(level.patch.vertex_count() - level.patch.free_count == fixed);
    CHECK(ball.levels.back().patch.vertex_count() - ball.levels.back().patch.free_count < fixed);
}

TEST_CASE("levels shrink evenly and keep the topology, the outline and which vertices are fixed") {
    for (const int n : {60, 120}) {  // one domain, and several
        const Ball ball(n);
        REQUIRE(ball.levels.size() >= 3);
        int finer = ball.patch().free_count;
        for (const CoarseLevel& level : ball.levels) {
            const double factor = static_cast<double>(finer) / level.patch.free_count;
            CHECK(factor > 3.0);
            CHECK(factor < 6.0);
            finer = level.patch.free_count;
            CHECK(euler_number(level.patch) == 1);
            CHECK(level.patch.loop_count() == 1);
            CHECK(level.patch.vertex_count() - level.patch.free_count >= 8);
            for (int v = 0; v < level.patch.vertex_count(); ++v) {
                CHECK(level.patch.is_free(v) == ball.patch().is_free(level.patch.to_input[v]));
                CHECK(level.patch.ring(v).closed() == level.patch.is_free(v));
            }
            for (const WeightedEdge& edge : level.weights) CHECK(edge.weight > 0.0);
        }
    }
}

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

TEST_CASE("corners of the outline and pins stay on all levels") {
    const Ball ball(40);
    const Patch& coarsest = ball.levels.back().patch;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            int corner = 0;
            for (int v = 0; v < ball.patch().vertex_count(); ++v) {
                const auto score = [&](int k) { return x * ball.single.points(0, k) + y * ball.single.points(1, k); };
                if (score(v) > score(corner)) corner = v;
            }
            CHECK(std::count(coarsest.to_input.begin(), coarsest.to_input.end(), corner) == 1);
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

TEST_CASE("no vertex that a pass removes hangs on another one of it, and values come back in the order of the passes") {
    const Ball ball(100);
    const Transfer& transfer = ball.levels.front().transfer;
    const Removals& removals = transfer.removals;
    REQUIRE(removals.pass_begin.size() > 2);
    CHECK(removals.pass_begin.back() == removals.size());
    Indices pass_of(transfer.fine_count, none);
    for (std::size_t pass = 1; pass < removals.pass_begin.size(); ++pass) {
        for (int k = removals.pass_begin[pass - 1]; k < removals.pass_begin[pass]; ++k)
            pass_of[removals.vertex[k]] = static_cast<int>(pass);
    }
    for (int k = 0; k < removals.size(); ++k) {
        const int own = pass_of[removals.vertex[k]];
        for (int j = removals.begin[k]; j < removals.begin[k + 1]; ++j) {
            const int other = pass_of[removals.neighbours[j]];
            CHECK((other == none || other > own));
        }
    }
    // Means of a constant are that constant, whatever was there before.
    const Points coarse = Vector3(1.0, 2.0, 3.0).replicate(1, transfer.coarse_count());
    Points fine = Vector3(1.0, 2.0, 3.0).replicate(1, transfer.fine_count);
    fine.leftCols(ball.patch().free_count).setZero();
    transfer.prolong_means(coarse, ball.patch().free_count, fine);
    CHECK((fine.colwise() - Vector3(1.0, 2.0, 3.0)).cwiseAbs().maxCoeff() < 1e-5);
}

TEST_CASE("an ordering that is found ahead of the surface changes nothing") {
    const Ball ball(30);
    const Stiffness stiffness = test::stiffness_of(ball.single);
    const Problem problem{ball.patch(), ball.fixed_points(), ball.fixed_points(), Lambda(ball.weights), {}};
    const VectorX rhs = VectorX::Random(ball.patch().free_count);
    std::vector<VectorX> solved;
    for (const bool ahead : {false, true}) {
        const auto made = make_normal_operator(problem, {}, Solves::few);
        if (ahead) made->prepare();
        REQUIRE(made->update(stiffness, Progress()));
        solved.emplace_back(made->solve(rhs));
    }
    CHECK(solved[0] == solved[1]);
}

TEST_CASE("an interpolated sphere is one to the fourth order in the spacing") {
    // Means of points lie h²/2 below the sphere; what the lift leaves falls by 16 where h halves (8 to be safe).
    std::vector<double> errors;
    for (const int n : {20, 40}) {
        const Ball ball(n, 0.1, 20);
        const CoarseLevel& level = ball.levels.front();
        const Points coarse = of_level(level, ball.single.points);
        Points fixed = ball.single.points;
        fixed.leftCols(ball.patch().free_count).setZero();
        BentPoints fine{fixed, fixed, {}};
        level.transfer.prolong_surface({coarse, coarse, {}}, ball.patch().free_count, fine);
        errors.push_back((fine.points.colwise().norm().array() - 1.0).abs().maxCoeff());
    }
    CHECK(errors[0] < 2e-3);
    CHECK(errors[1] < errors[0] / 8.0);
}

TEST_CASE("the weights of a coarse level put its vertices where the fine level has them") {
    // Edges in the half x > 0 are nine times as strong: they draw vertices there together.
    const Ball ball(40, 0.3, 100);
    InnerWeights uneven = ball.weights;
    for (WeightedEdge& edge : uneven) {
        if (ball.single.points(0, edge.i) + ball.single.points(0, edge.j) > 0.0) edge.weight = 9.0;
    }
    const SymmetricStep fine(ball.patch(), uneven, ball.fixed_points(), Progress());
    const auto levels = coarsen(ball.patch(), uneven, {ball.single.points, ball.single.points}, 100);
    const CoarseLevel& level = levels.front();
    const Points all = of_level(level, ball.single.points);
    const Points fixed = all.rightCols(level.patch.vertex_count() - level.patch.free_count);
    Points wanted = ball.single.points;
    wanted.leftCols(ball.patch().free_count) = fine.harmonic_positions();
    const auto mean_error = [&](const InnerWeights& weights) {
        const Points positions = SymmetricStep(level.patch, weights, fixed, Progress()).harmonic_positions();
        const Points difference = positions - of_level(level, wanted).leftCols(level.patch.free_count);
        return difference.colwise().norm().mean();
    };
    // Of an outline two units wide. Weights that know nothing of the fine ones are far off.
    CHECK(mean_error(level.weights) < 0.04);
    CHECK(mean_error(level.weights) < 0.5 * mean_error(uniform_weights(level.patch)));
}

TEST_CASE("before and after the coarse level a cycle smooths by the Chebyshev polynomial of the fourth kind") {
    class Nothing : public LaplaceCycle {
    public:
        [[nodiscard]] double scale() const override { return 1.0; }
        void cycle(SingleField& /*r*/, SingleField& x) const override { x.setZero(); }
    };
    const Ball ball(14, 0.3, 30);
    REQUIRE(!ball.levels.empty());
    const int count = ball.patch().vertex_count();
    const int free = ball.patch().free_count;
    InnerWeights weights = ball.weights;
    for (std::size_t k = 0; k < weights.size(); ++k) weights[k].weight = 1.0 + 0.5 * std::sin(static_cast<double>(k));
    for (const bool uniform : {true, false}) {
        const RingMatrix laplacian(count, uniform ? ball.weights : weights);
        Eigen::MatrixXd L = Eigen::MatrixXd::Zero(count, count);
        for (int i = 0; i < count; ++i) {
            for (int k = laplacian.begin[i]; k < laplacian.begin[i + 1]; ++k) {
                L(i, i) += laplacian.weight(k);
                L(i, laplacian.columns[k]) -= laplacian.weight(k);
            }
        }
        const Eigen::MatrixXd A = L.topLeftCorner(free, free);
        const Nothing nothing;
        const MultigridStep step(ball.patch(), laplacian, ball.fixed_points(), Restriction(ball.levels[0].transfer),
                                 nothing);
        SingleField r = SingleField::Random(4, count);
        r.rightCols(count - free).setZero();
        SingleField x = SingleField::Random(4, count);
        const Eigen::MatrixXd exact = A.llt().solve(Eigen::MatrixXd(r.leftCols(free).cast<double>().transpose()));
        step.cycle(r, x);
        // sin 5θ/2 over 5 sin θ/2, of cos θ = 1 − the eigenvalue of D⁻¹A, twice.
        const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(free, free);
        const Eigen::MatrixXd c = identity - A.diagonal().cwiseInverse().asDiagonal() * A;
        const Eigen::MatrixXd left = (4.0 * c * c + 2.0 * c - identity) / 5.0;
        const Eigen::MatrixXd expected = exact - left * left * exact;
        CHECK((x.leftCols(free).cast<double>().transpose() - expected).norm() < 1e-5 * expected.norm());
        CHECK(x.rightCols(count - free).isZero());
    }
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
    CHECK(multigrid.merit(ball.single.points, ball.single.points) >
          0.0);  // and both measure the energy that steps lower
}

TEST_CASE("on a sphere a tangential step that knows how the planes turn is Newton's") {
    // Out to 70° from the pole, 100° in the corners.
    const Ball ball(40, 0.2, 300, [](double u, double v) {
        const double x = 2.0 * u - 1.0;
        const double y = 2.0 * v - 1.0;
        const double r = std::max(std::hypot(x, y), 1e-9);
        return Vector3(std::sin(1.22 * r) / r * x, std::sin(1.22 * r) / r * y, std::cos(1.22 * r));
    });
    REQUIRE(ball.levels.size() == 1);
    const int free = ball.patch().free_count;
    const CoarseLevel& level = ball.levels[0];
    const Points of_coarse = of_level(level, ball.single.points);
    const FactorisedLaplacian base(level.patch, level.weights,
                                   of_coarse.rightCols(level.patch.vertex_count() - level.patch.free_count),
                                   Progress());
    const MultigridStep multigrid(ball.patch(), RingMatrix(ball.patch().vertex_count(), ball.weights),
                                  ball.fixed_points(), Restriction(level.transfer), base);
    const SymmetricStep factorised(ball.patch(), ball.weights, ball.fixed_points(), Progress());
    PatchCurvature curvature{VectorX::Constant(free, -1.0), Points::Zero(3, free)};
    curvature.form.row(0).setConstant(-1.0);
    curvature.form.row(2).setConstant(-1.0);
    // Points of the unit sphere are their own normals.
    const auto moved = [&](const TangentialStep& step, Points points, bool turning) {
        const Points normals = points.leftCols(free);
        const ShapeOperators turns = turning ? shape_operators(curvature, normals, free) : ShapeOperators();
        points.leftCols(free) += step.displacement(points, {normals, turns}, {0.05, 30});
        points.colwise().normalize();
        return points;
    };
    Points even = ball.single.points;
    for (int k = 0; k < 12; ++k) even = moved(factorised, even, true);
    const double balance = moved(factorised, even, true).leftCols(free).operator-(even.leftCols(free)).norm();
    CHECK(balance < 1e-6);
    Points start = even;
    for (int v = 0; v < free; ++v) {
        const double bump = 0.02 * std::max(even(2, v) - 0.3, 0.0);
        start.col(v) = (even.col(v) + bump * Vector3::UnitX()).normalized();
    }
    const double off = (start - even).norm();
    for (const TangentialStep* step :
         {static_cast<const TangentialStep*>(&multigrid), static_cast<const TangentialStep*>(&factorised)}) {
        const double known = (moved(*step, start, true) - even).norm() / off;
        const double fixed = (moved(*step, start, false) - even).norm() / off;
        CHECK(known < 0.12);
        CHECK(fixed > 0.2);
    }
}

TEST_CASE("where turning planes leave no positive definite system they count as fixed") {
    const Ball ball(20);
    const SymmetricStep step(ball.patch(), ball.weights, ball.fixed_points(), Progress());
    const Points& points = ball.single.points;
    ShapeOperators wild = ShapeOperators::Zero(6, ball.patch().free_count);
    wild.topRows<3>().setConstant(1e6F);  // about the radius of a millionth of the patch
    CHECK(step.displacement(points, {points, wild}) == step.displacement(points, points));
}

TEST_CASE("means are lifted onto the sphere that points at the same angle lie on") {
    for (const double angle : {0.1, 0.4}) {
        Points ring(3, 5);
        for (int k = 0; k < 5; ++k) {
            const double phi = 1.3 * k + 0.2 * k * k;
            ring.col(k) << std::sin(angle) * std::cos(phi), std::sin(angle) * std::sin(phi), std::cos(angle);
        }
        // Weights that balance the ring: the mean lies on the axis.
        const Eigen::Matrix<double, 3, 5> rows =
            (Eigen::Matrix<double, 3, 5>() << ring.topRows<2>(), Eigen::RowVectorXd::Ones(5)).finished();
        const Eigen::VectorXf weights = rows.completeOrthogonalDecomposition().solve(Vector3::UnitZ()).cast<float>();
        const std::vector<int> all{0, 1, 2, 3, 4};
        const LiftedMean lifted = lifted_mean({ring, ring, {}}, all.data(), weights.data(), 5);
        CHECK((lifted.point - Vector3::UnitZ()).norm() < 1e-6);  // half-way: 7e-5 and .02
        CHECK((lifted.normal - Vector3::UnitZ()).norm() < 1e-6);
    }
}

TEST_CASE("interpolated normals know how the curvature varies") {
    // z = x³ + x y²: at the origin the plane is level, and the mean of the normals around leans by 2 h².
    const double h = 0.05;
    BentPoints ring{Points(3, 6), Points(3, 6), ShapeOperators(6, 6)};
    for (int k = 0; k < 6; ++k) {
        const double phi = 1.0471975512 * k + 0.1;
        const double x = h * std::cos(phi);
        const double y = h * std::sin(phi);
        ring.points.col(k) << x, y, x * x * x + x * y * y;
        ring.normals.col(k) = Vector3(-(3.0 * x * x + y * y), -2.0 * x * y, 1.0).normalized();
        ring.shapes.col(k) << static_cast<float>(-6.0 * x), static_cast<float>(-2.0 * x), 0.0F,
            static_cast<float>(-2.0 * y), 0.0F, 0.0F;
    }
    const std::vector<int> all{0, 1, 2, 3, 4, 5};
    const std::vector<float> weights(6, 1.0F);
    const auto lean = [&](const BentPoints& points) {
        return (lifted_mean(points, all.data(), weights.data(), 6).normal - Vector3::UnitZ()).norm();
    };
    const double plain = lean({ring.points, ring.normals, {}});
    CHECK(plain == doctest::Approx(2.0 * h * h).epsilon(0.01));
    CHECK(lean(ring) < 0.01 * plain);
    ring.shapes(0, 2) = std::numeric_limits<float>::quiet_NaN();  // one alone is missing: none counts
    CHECK(lean(ring) == doctest::Approx(plain));
    CHECK(mean_shape(ring.shapes, all.data(), weights.data(), 6).allFinite());
}

TEST_CASE("fixed vertices that a coarse level lacks bend as their neighbours do") {
    const Ball ball(40, 0.2, 100);
    const CoarseLevel& level = ball.levels.front();
    const Points coarse = of_level(level, ball.single.points);
    ShapeOperators shapes(6, coarse.cols());  // I − n nᵀ
    for (Eigen::Index v = 0; v < coarse.cols(); ++v) {
        const Eigen::Matrix3d w = Eigen::Matrix3d::Identity() - coarse.col(v) * coarse.col(v).transpose();
        shapes.col(v) << Eigen::Vector<double, 6>(w(0, 0), w(1, 1), w(2, 2), w(0, 1), w(0, 2), w(1, 2)).cast<float>();
    }
    Points fixed = ball.single.points;
    const int free = ball.patch().free_count;
    fixed.leftCols(free).setZero();
    BentPoints fine{fixed, fixed, {}};
    level.transfer.prolong_surface({coarse, coarse, shapes}, free, fine);
    REQUIRE(fine.shapes.cols() == fixed.cols());
    CHECK(fine.shapes.rightCols(fixed.cols() - free).array().isNaN().any());
    even_out(RingMatrix(ball.patch().vertex_count(), ball.weights), free, 1, fine);
    CHECK(fine.shapes.allFinite());
    CHECK((fine.normals - fine.points.colwise().normalized()).colwise().norm().maxCoeff() < 0.01);
}

TEST_CASE("shape operators: of spheres by either way, and of a cylinder across and along it") {
    const Ball ball(40, 0.2);
    const int free = ball.patch().free_count;
    const ShapeOperators shapes = shape_operators(ball.patch(), ball.single.points, ball.single.points);
    for (int v = 0; v < free; ++v) {
        const Vector3 n = ball.single.points.col(v);
        const Vector3 t = n.cross(Vector3(0.3, 0.5, 0.1)).normalized();
        CHECK((turn(shapes, v, t.cast<float>()).cast<double>() - t).norm() < 0.02);
        CHECK(turn(shapes, v, n.cast<float>()).norm() < 1e-5F);
    }
    PatchCurvature cylinder{VectorX(1), Points(3, 1)};
    const Points normal = Vector3(0.6, 0.8, 0.0);  // of radius 2 around the z axis
    const Frame frame(normal.col(0));
    const Vector3 around(-0.8, 0.6, 0.0);
    const Eigen::Vector2d t(around.dot(frame.u), around.dot(frame.v));
    cylinder.form << -0.5 * t.x() * t.x(), -t.x() * t.y(), -0.5 * t.y() * t.y();
    const ShapeOperators shape = shape_operators(cylinder, normal, 1);
    CHECK((turn(shape, 0, around.cast<float>()) - 0.5F * around.cast<float>()).norm() < 1e-6F);
    CHECK(turn(shape, 0, Eigen::Vector3f::UnitZ()).norm() < 1e-6F);
}

TEST_CASE("raised vertices have the normals of the surface that they lead to") {
    const test::Single single = test::single_patch(test::grid(12, 0.3, test::flat));
    const Patch& patch = single.patch();
    SurfaceState state;
    state.points = single.points;
    state.normals = Vector3::UnitZ().replicate(1, patch.vertex_count());
    const VectorX heights =
        (0.02 * single.points.row(0) - 0.01 * single.points.row(1)).head(patch.free_count).transpose();
    const Raised up = raised(patch, state, heights);
    const Vector3 exact = Vector3(-0.02, 0.01, 1.0).normalized();
    for (int v = 0; v < patch.free_count; ++v) {
        CHECK(up.points(2, v) == doctest::Approx(heights[v]));
        const auto ring = patch.ring(v).vertices;
        const bool inside = std::ranges::all_of(ring, [&](int j) { return patch.is_free(j); });
        if (inside) CHECK((up.normals.col(v) - exact).norm() < 1e-5);
    }
}

TEST_CASE("harmonic positions are balanced to double precision, whatever the factor is kept in") {
    const Ball ball(30);
    const int free = ball.patch().free_count;
    const SymmetricStep step(ball.patch(), ball.weights, ball.fixed_points(), Progress());
    Points points = ball.single.points;
    points.leftCols(free) = step.harmonic_positions();
    const RingMatrix laplacian(ball.patch().vertex_count(), ball.weights);
    Points pull(3, free);
    laplacian.apply(points, free, [&](int i, const Vector3& product) { pull.col(i) = product; });
    CHECK(pull.cwiseAbs().maxCoeff() < 1e-11);
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
