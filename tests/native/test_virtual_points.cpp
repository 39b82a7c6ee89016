#include <doctest/doctest.h>

#include <cmath>

#include "geometry/shape_operator.h"

using namespace fairing;

namespace {

Vector3 on_circle(double angle) { return {std::sin(angle), 0.0, std::cos(angle)}; }

}  // namespace

TEST_CASE("on a circle the virtual point is the middle of the arc") {
    for (const double half : {0.05, 0.3, 0.8}) {
        const NormalChord chord{on_circle(-half), on_circle(half), on_circle(-half), on_circle(half), Vector3::UnitZ()};
        CHECK((virtual_point(chord) - Vector3(0, 0, 1)).norm() < 1e-14);
    }
}

TEST_CASE("through an inflection the virtual point moves without a jump") {
    Vector3 last;
    double largest = 0.0;
    constexpr int steps = 1000;
    for (int k = 0; k <= steps; ++k) {
        const double beta = 0.5 - 1.0 * k / steps;
        const Vector3 nb(std::sin(beta), 0, std::cos(beta));
        const Vector3 p = virtual_point({{-1, 0, 0}, {1, 0, 0}, Vector3::UnitZ(), nb, Vector3::UnitZ()});
        if (k > 0) largest = std::max(largest, (p - last).norm());
        last = p;
    }
    CHECK(largest < 1e-3);
}
