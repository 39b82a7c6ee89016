#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "pipes.h"
#include "shape/girth.h"

using namespace fairing;
using test::Pipe;

namespace {

double length_of(const Pipe& pipe) { return pipe.single.points.row(2).maxCoeff(); }

// The pipe's points with the radius r(z / length).
Points shaped(const Pipe& pipe, const std::function<double(double)>& radius) {
    Points points = pipe.single.points;
    for (auto point : points.colwise()) point.head<2>() *= radius(point[2] / length_of(pipe));
    return points;
}

GirthRange girth(const Pipe& pipe, const Points& points) {
    const auto range = girth_range(pipe.single.patch(), points);
    REQUIRE(range);
    return *range;
}

}  // namespace

TEST_CASE("cross-sections of a pipe have the radii of its circles") {
    const Pipe pipe(40);
    const auto sections = CrossSections::of(pipe.single.patch());
    REQUIRE(sections);
    REQUIRE(sections->count() == 1);
    const VectorX straight = sections->radii(0, pipe.single.points);
    CHECK(straight.minCoeff() == doctest::Approx(1.0).epsilon(5e-3));
    CHECK(straight.maxCoeff() == doctest::Approx(1.0).epsilon(5e-3));
    const Points waisted = shaped(pipe, [](double t) { return 1.0 - 0.7 * std::sin(std::numbers::pi * t); });
    CHECK(sections->radii(0, waisted).minCoeff() == doctest::Approx(0.3).epsilon(0.02));
}

TEST_CASE("loops that are no tubes' ends are distinguished from those of a pipe") {
    const Pipe pipe(20);
    CHECK(is_between_tubes(pipe.single.patch(), pipe.single.points, pipe.problem.fixed_normals));
    const Pipe steep(20, 1.2);  // leans by 69°: a ball between two small caps
    CHECK_FALSE(is_between_tubes(steep.single.patch(), steep.single.points, steep.problem.fixed_normals));
}
