#include <doctest/doctest.h>

#include "method/bulb.h"
#include "pipes.h"

using namespace fairing;

namespace {

// Its middle is wider by that share of the radius, its ends as they are.
Points widened(const test::Pipe& pipe, double share) {
    Points points = pipe.single.points;
    const double length = points.row(2).maxCoeff();
    for (auto point : points.colwise())
        point.head<2>() *= 1.0 + share * std::pow(std::sin(std::numbers::pi * point[2] / length), 2);
    return points;
}

bool may_be(const test::Pipe& pipe, const Points& points) { return may_be_bulb(pipe.problem, points, Progress()); }

}  // namespace

TEST_CASE("a tube that lies on the one swept between its outlines is no bulb") {
    const test::Pipe pipe(50);  // 5.7 radii
    CHECK_FALSE(may_be(pipe, widened(pipe, 0.0)));
    CHECK_FALSE(may_be(pipe, widened(pipe, 0.03)));
    CHECK(may_be(pipe, widened(pipe, 0.1)));
    CHECK(may_be(pipe, widened(pipe, -0.15)));
}

TEST_CASE("short tubes have no room for a bulb") {
    const test::Pipe ring(15);  // 1.7 radii
    CHECK_FALSE(may_be(ring, widened(ring, 0.2)));
}
