#include <doctest/doctest.h>

#include "iteration/accelerated_iteration.h"
#include "iteration/continuation.h"
#include "meshes.h"
#include "operators/biharmonic_operator.h"
#include "operators/normal_operator.h"
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

TEST_CASE("however far off the surface is, no step is longer than a tenth of the diameter") {
    Ball far;
    blow_up(far);
    far.problem.options.max_iterations = 2;  // the second one measures where the first has led
    const Points step = far.solve().points - far.start;
    CHECK(step.colwise().norm().maxCoeff() == doctest::Approx(0.1));
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
