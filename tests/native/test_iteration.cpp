#include <doctest/doctest.h>

#include <cmath>

#include "iteration/accelerated_iteration.h"
#include "iteration/reaction.h"
#include "meshes.h"
#include "operators/biharmonic_operator.h"
#include "operators/workspace.h"
#include "problem/solution.h"

using namespace fairing;

namespace {

// Part of the unit sphere with its own normals at the border, and its inner vertices moved along theirs to and fro.
struct Ball {
    explicit Ball(int n = 10, double jitter = 0.2) : single(test::single_patch(test::grid(n, jitter, test::sphere))) {}

    test::Single single;
    Problem problem = make_problem();
    Points start = dented();

    [[nodiscard]] const Patch& patch() const { return single.patch(); }

    [[nodiscard]] Problem make_problem() const {
        const Points fixed = single.points.rightCols(patch().vertex_count() - patch().free_count);
        return {patch(), fixed, fixed, uniform_weights(patch()), {}};
    }

    [[nodiscard]] Points dented() const {
        Points points = single.points;
        for (int v = 0; v < patch().free_count; ++v) points.col(v) *= v % 2 == 0 ? 1.02 : 0.98;
        return points;
    }

    [[nodiscard]] Workspace workspace() const {
        return {std::make_unique<BiharmonicOperator>(patch()),
                make_tangential_step(patch(), problem.weights, problem.fixed_points, Progress())};
    }

    [[nodiscard]] Solution solve() const {
        Workspace work = workspace();
        return iterate(problem, work, start, Progress());
    }
};

double off_the_sphere(const Points& points) { return (points.colwise().norm().array() - 1.0).abs().maxCoeff(); }

double distance(const Points& a, const Points& b) { return (a - b).colwise().norm().maxCoeff(); }

// Starts far off: four tenths of the radius in the middle.
void blow_up(Ball& ball) {
    for (int v = 0; v < ball.patch().free_count; ++v) {
        const Vector3 p = ball.single.points.col(v);
        const double x = 2.0 * p.x() / p.z();  // −1 … 1
        const double y = 2.0 * p.y() / p.z();
        ball.start.col(v) = (1.0 + 0.4 * (1.0 - x * x) * (1.0 - y * y)) * p;
    }
}

}  // namespace

TEST_CASE("the iteration finds the sphere that its border belongs to") {
    const Ball ball;
    const Solution solution = ball.solve();
    CHECK(solution.termination == Termination::converged);
    CHECK(off_the_sphere(solution.points) < 1e-6);
}

TEST_CASE("however far off the surface is, no step is longer than a tenth of the diameter") {
    Ball far;
    blow_up(far);
    far.problem.options.max_iterations = 2;  // the second one measures where the first has led
    const Points step = far.solve().points - far.start;
    CHECK(step.colwise().norm().maxCoeff() == doctest::Approx(0.1));
}

TEST_CASE("an iteration whose steps no longer shrink is given up") {
    Ball ball;
    ball.problem.options.tolerance = 0.0;  // nobody reaches that: round-off keeps the steps above
    ball.problem.options.max_iterations = 500;
    const Solution solution = ball.solve();
    CHECK(solution.termination == Termination::stalled);
    CHECK(solution.iterations < 150);
    CHECK(off_the_sphere(solution.points) < 1e-6);  // the best of all is kept
}

TEST_CASE("an iteration that has to contract ends where its steps shrink too slowly") {
    Ball far;
    blow_up(far);
    const Solution patient = far.solve();
    CHECK(patient.termination == Termination::stalled);
    far.problem.conduct.contracts = true;
    const Solution given_up = far.solve();
    CHECK(given_up.termination == Termination::stalled);
    CHECK(given_up.iterations < 10);
    CHECK(patient.iterations > 2 * given_up.iterations);
    Ball near;
    near.problem.conduct.contracts = true;
    CHECK(near.solve().termination == Termination::converged);
}

TEST_CASE("an iteration that stays far from a surface ends early where that is asked, one that is near goes on") {
    Ball far;
    blow_up(far);
    far.problem.conduct.nears_within = 3;
    const Solution given_up = far.solve();
    CHECK(given_up.termination == Termination::stalled);
    CHECK(given_up.iterations == 3);
    Ball near;
    near.problem.conduct.nears_within = 6;
    CHECK(near.solve().termination == Termination::converged);
    Solution creeping;
    creeping.first_step = near_step;
    creeping.least_step = 0.9 * near_step;
    CHECK(!stays_far(creeping));
}

TEST_CASE("where steps shrink fast the iteration ends without a last one that is within the tolerance") {
    Ball tight;
    tight.problem.options.tolerance = 1e-11;
    const Points exact = tight.solve().points;
    int sooner = 0;
    for (double tolerance = 1e-3; tolerance > 1e-9; tolerance *= 0.4) {
        Ball ball;
        ball.problem.options.tolerance = tolerance;
        const Solution solution = ball.solve();
        CHECK(solution.termination == Termination::converged);
        CHECK(distance(solution.points, exact) < tolerance);
        if (solution.last_step > tolerance) ++sooner;
    }
    CHECK(sooner > 0);
}

TEST_CASE("steps that shrank by luck end no iteration whose residual says otherwise") {
    // By the steps alone these end 2.4 to 5.2 tolerances off.
    struct Case {
        int n;
        double jitter;
        double tolerance;
    };
    for (const Case& c : {Case{7, 0.3, 2.8e-5}, Case{12, 0.0, 5.8e-5}, Case{12, 0.2, 1e-3}, Case{14, 0.0, 4.7e-6}}) {
        Ball tight(c.n, c.jitter);
        tight.problem.options.tolerance = 1e-11;
        Ball ball(c.n, c.jitter);
        ball.problem.options.tolerance = c.tolerance;
        CHECK(distance(ball.solve().points, tight.solve().points) < c.tolerance);
    }
}

TEST_CASE("of a surface that is only a start the last step is taken, too") {
    Ball ball;
    ball.problem.options.tolerance = 0.1;  // more than twice the first step
    CHECK(distance(ball.solve().points, ball.start) == 0.0);
    ball.problem.conduct.start_only = true;
    const Solution solution = ball.solve();
    CHECK(solution.termination == Termination::converged);
    Ball once;
    once.problem.options.max_iterations = 2;  // the second one measures where the first has led
    CHECK(distance(solution.points, once.solve().points) < 1e-12);
}

namespace {

// A ball raised by small smooth heights that end with slope zero, measured, and what K makes of its residual.
struct Bulge {
    Ball ball{24};
    VectorX heights;
    SurfaceState state;
    BiharmonicOperator normal{ball.patch()};
    VectorX answer;

    explicit Bulge(double height) : heights(ball.patch().free_count) {
        Points points = ball.single.points;
        for (int v = 0; v < ball.patch().free_count; ++v) {
            const Vector3 p = points.col(v);
            const double x = 2.0 * p.x() / p.z();
            const double y = 2.0 * p.y() / p.z();
            heights[v] = height * std::pow((1.0 - x * x) * (1.0 - y * y), 2);
            points.col(v) *= 1.0 + heights[v];
        }
        state = measured_surface(ball.problem, points);
        REQUIRE(normal.update(state.stiffness, Progress()));
        answer = normal.solve(outer_residual(ball.problem, state));
    }

    [[nodiscard]] double off(const VectorX& moves) const { return (moves + heights).norm() / heights.norm(); }
};

}  // namespace

TEST_CASE("along the normals of a curved surface K's answers are too short by what its own motion adds to H") {
    const Bulge bulge(1e-5);
    VectorX u = bulge.answer;
    double share = 0.0;
    add_reaction(bulge.ball.problem, bulge.state, bulge.normal, share, u);
    CHECK(bulge.off(bulge.answer) > 3.0 * bulge.off(u));
    CHECK(bulge.off(u) < 0.02);
    CHECK(share > 0.02);
    CHECK(share < 0.3);
    Problem bent = bulge.ball.problem;  // of other equations K leaves out more
    bent.options.equation = Equation::minimal_energy;
    VectorX other = bulge.answer;
    add_reaction(bent, bulge.state, bulge.normal, share, other);
    CHECK(other == bulge.answer);
}
