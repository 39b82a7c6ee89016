#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "pipes.h"
#include "shape/girth.h"
#include "start/swept_tube.h"

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

std::vector<Indices> loops_of(const Pipe& pipe) {
    std::vector<Indices> loops = pipe.single.patch().loops();
    for (Indices& loop : loops) {
        for (int& v : loop) v -= pipe.single.patch().free_count;
    }
    return loops;
}

// A quarter of a torus: two rims of radius 1 around circles of that radius.
struct Bend {
    std::vector<Indices> loops{{}, {}};
    Points points{3, 2 * count};
    Points normals{3, 2 * count};

    explicit Bend(double radius, double degrees) {
        for (int k = 0; k < 2 * count; ++k) {
            const double along = k < count ? 0.0 : degrees * std::numbers::pi / 180.0;
            const double around = 2.0 * std::numbers::pi * k / count;
            const Vector3 out(std::cos(along), std::sin(along), 0.0);
            normals.col(k) = std::cos(around) * out + std::sin(around) * Vector3::UnitZ();
            points.col(k) = radius * out + normals.col(k);
        }
        // The surface on the left: forwards around the first one, backwards around the last one.
        for (int k = 0; k < count; ++k) {
            loops[0].push_back(count - 1 - k);
            loops[1].push_back(count + k);
        }
    }

private:
    static constexpr int count = 64;
};

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

TEST_CASE("a tube is as long as its axis, in radii") {
    const Pipe pipe(50);
    const auto length = tube_length(loops_of(pipe), pipe.problem.fixed_points, pipe.problem.fixed_normals);
    REQUIRE(length);
    CHECK(*length == doctest::Approx(length_of(pipe)).epsilon(0.005));  // the circles are polygons
    for (const double degrees : {30.0, 90.0, 150.0}) {
        const Bend bend(3.0, degrees);
        const auto along = tube_length(bend.loops, bend.points, bend.normals);
        REQUIRE(along);
        CHECK(*along == doctest::Approx(3.0 * degrees * std::numbers::pi / 180.0).epsilon(0.01));
    }
}
