#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "accept/accept.h"
#include "geometry/self_intersection.h"
#include "method/solve.h"
#include "pipes.h"
#include "shape/kinks.h"
#include "shape/limits.h"
#include "stand_in/stand_in.h"
#include "start/quick_surface.h"

using namespace fairing;
using test::Pipe;

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

// A pipe that knows its own shape.
struct Known : Pipe {
    explicit Known(int rows, double lean = 0.0) : Pipe(rows, lean) { problem.before = single.points; }
    [[nodiscard]] double length() const { return single.points.row(2).maxCoeff(); }
    // Its points with the radius r(z).
    [[nodiscard]] Points shaped(const std::function<double(double)>& radius) const {
        Points points = single.points;
        for (auto point : points.colwise()) point.head<2>() *= radius(point[2] / length());
        return points;
    }
    [[nodiscard]] double middle_radius(const Points& points) const {
        double sum = 0.0;
        int count = 0;
        for (int v = 0; v < single.patch().free_count; ++v) {
            if (std::abs(single.points(2, v) - 0.5 * length()) > 0.1) continue;
            sum += points.col(v).head<2>().norm();
            ++count;
        }
        return sum / count;
    }
    [[nodiscard]] int vertex_near(const Vector3& place) const {
        int found = 0;
        (single.points.leftCols(single.patch().free_count).colwise() - place).colwise().norm().minCoeff(&found);
        return found;
    }
};

Points smoothed_by(const Known& pipe, double wavelength) {
    auto shape = ShapeBefore::of(pipe.problem, Progress());
    REQUIRE(shape);
    const auto points = shape->smoothed(VectorX::Constant(pipe.single.patch().vertex_count(), wavelength), Progress());
    REQUIRE(points);
    return *points;
}

// One wave of the radius, 1 at the ends and 1 + height in the middle.
Points waved(const Known& pipe, double height) {
    return pipe.shaped([=](double t) { return 1.0 + 0.5 * height * (1.0 - std::cos(2.0 * std::numbers::pi * t)); });
}

BlemishFinder finder(const Known& pipe) { return {pipe.problem, *pipe.problem.before}; }

// A wall that bulges through the wall across from it, without folds.
Points pierced(const Known& pipe, double height) {
    constexpr double width = 0.6;
    const Vector3 centre(1.0, 0.0, height * pipe.length());
    Points points = pipe.single.points;
    for (auto point : points.leftCols(pipe.single.patch().free_count).colwise())
        point += std::exp(-(point - centre).squaredNorm() / (width * width)) * Vector3(-2.4, 0.1, 0.05);
    return points;
}

Solution taken(const Points& points, Provenance provenance) {
    Solution solution;
    solution.points = points;
    solution.termination = Termination::converged;
    solution.provenance = provenance;
    return solution;
}

}  // namespace

TEST_CASE("a pipe that is smoothed as a whole has the waist of the closed form") {
    for (const double lean : {0.0, 0.3}) {
        const Known pipe(30, lean);
        const double a = 0.5 * pipe.length();  // r'''' − 2 r'' + r = 0 with r = 1 at the ends, |r'| = sin lean
        const double waist =
            (std::sinh(a) + a * std::cosh(a) - std::sin(lean) * a * std::sinh(a)) / (std::sinh(a) * std::cosh(a) + a);
        CHECK(pipe.middle_radius(smoothed_by(pipe, endless)) == doctest::Approx(waist).epsilon(5e-3));
    }
}

TEST_CASE("the shape before goes with its boundary") {
    Known pipe(20);
    const Vector3 move(0.3, -0.2, 0.1);
    pipe.problem.fixed_points.colwise() += move;
    const auto shape = ShapeBefore::of(pipe.problem, Progress());
    REQUIRE(shape);
    CHECK((shape->points() - (pipe.single.points.colwise() + move)).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a shape that is not known, or crumpled, is not smoothed") {
    Known pipe(20);
    CHECK(smoothed(pipe.problem, Progress()));
    Points crumpled = pipe.single.points;
    crumpled.leftCols(pipe.single.patch().free_count).array() *=
        Points::Random(3, pipe.single.patch().free_count).array();
    pipe.problem.before = crumpled;
    CHECK_FALSE(ShapeBefore::of(pipe.problem, Progress()));
    CHECK_FALSE(smoothed(pipe.problem, Progress()));
    pipe.problem.before = Points(3, 0);
    CHECK_FALSE(smoothed(pipe.problem, Progress()));
}

TEST_CASE("blemishes are what the shape before has not") {
    const Known pipe(40);
    CHECK(finder(pipe).in(pipe.single.points).absent());

    const Points torn = pierced(pipe, 0.5);
    const int pulled = pipe.vertex_near({1.0, 0.0, 0.5 * pipe.length()});
    const Blemishes found = finder(pipe).in(torn);
    CHECK_FALSE(found.torn.empty());
    Known before = pipe;
    before.problem.before = torn;
    CHECK(finder(before).in(torn).absent());

    Points knob = pipe.single.points;
    knob.col(pulled).head<2>() *= 1.15;
    const Indices bent = finder(pipe).in(knob).bent;
    CHECK(std::find(bent.begin(), bent.end(), pulled) != bent.end());
    before.problem.before = knob;
    CHECK(finder(before).in(knob).bent.empty());

    const Points thread = pipe.shaped([](double t) { return 1.0 - 0.6 * std::sin(std::numbers::pi * t); });
    const Blemishes narrow = finder(pipe).in(thread);
    REQUIRE_FALSE(narrow.narrow.empty());
    for (const int v : narrow.narrow) CHECK(thread.col(v).head<2>().norm() < waist + 0.05);
    before.problem.before = thread;
    CHECK(finder(before).in(thread).narrow.empty());

    const Blemishes slender = finder(pipe).in(waved(pipe, waist - 1.05));
    CHECK(slender.bent.empty());
    CHECK(slender.all() == slender.narrow);
    CHECK_FALSE(slender.absent());
    CHECK(finder(pipe).in(waved(pipe, waist - 0.95)).narrow.empty());

    const Indices wide = finder(pipe).in(waved(pipe, 0.5)).wide;
    REQUIRE_FALSE(wide.empty());
    for (const int v : wide) CHECK(waved(pipe, 0.5).col(v).head<2>().norm() > balloon - 0.05);
    CHECK(finder(pipe).in(waved(pipe, 0.3)).wide.empty());
    before.problem.before = waved(pipe, 0.5);
    CHECK(finder(before).in(waved(pipe, 0.5)).wide.empty());
    CHECK(finder(before).in(waved(pipe, 0.0)).narrow.empty());  // a swelling that is gone leaves no waist
    before.problem.before = waved(pipe, -0.5);
    CHECK(finder(before).in(waved(pipe, 0.0)).wide.empty());
}

TEST_CASE("an accepted surface is the answer, whatever its girth") {
    for (const double height : {0.6, -0.6}) {
        const Known pipe(10);
        const Points wave = waved(pipe, height);
        Solution solution = taken(wave, Provenance::equation);
        solution.boundary_normals = pipe.problem.fixed_normals;
        CHECK(flaw_of(pipe.problem, solution) == Flaw::absent);
    }
    CHECK(solve(Known(10).problem, 0.0, Progress()).provenance == Provenance::equation);
}

TEST_CASE("a smoothed shape may keep the crossings that were there, and no others") {
    Known pipe(40);
    const Points crossing = pierced(pipe, 0.5);
    REQUIRE_FALSE(crossing_triangles(pipe.single.patch().triangles, crossing).empty());
    pipe.problem.before = crossing;
    const auto flaw_at = [&](const Points& points, Provenance provenance) {
        Solution solution = taken(points, provenance);
        solution.boundary_normals = pipe.problem.fixed_normals;
        return flaw_of(pipe.problem, solution);
    };
    CHECK(flaw_at(crossing, Provenance::old_shape) == Flaw::absent);
    CHECK(flaw_at(crossing, Provenance::loft) == Flaw::crossing);
    CHECK(flaw_at(pierced(pipe, 0.25), Provenance::old_shape) == Flaw::crossing);
}

TEST_CASE("a surface beside its boundary may cross itself there, and nowhere else") {
    const auto flaw_at = [](const Known& pipe, const Points& points) {
        Solution solution = taken(points, Provenance::low_passed);
        solution.boundary_normals = pipe.problem.fixed_normals;
        return flaw_of(pipe.problem, solution);
    };
    const Known pipe(15);
    const Known ring(2);  // each of its triangles lies at the boundary
    CHECK(flaw_at(pipe, pierced(pipe, 0.5)) == Flaw::crossing);
    CHECK(flaw_at(ring, pierced(ring, 0.5)) != Flaw::crossing);
    CHECK(flaw_at(pipe, pipe.single.points) == Flaw::absent);
}
