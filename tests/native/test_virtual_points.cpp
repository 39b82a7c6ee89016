#include <doctest/doctest.h>

#include <cmath>

#include "geometry/virtual_points.h"

using namespace fairing;

namespace {

Vector3 on_circle(double angle) { return {std::sin(angle), 0.0, std::cos(angle)}; }

}  // namespace

TEST_CASE("a straight chord gives its midpoint, exactly") {
    const NormalChord chord{{0, 0, 0}, {2, 0, 0}, Vector3::UnitZ(), Vector3::UnitZ(), 2 * Vector3::UnitZ()};
    CHECK((virtual_point(chord) - Vector3(1, 0, 0)).norm() == 0.0);
}

TEST_CASE("on a circle the virtual point is the middle of the arc") {
    for (const double half : {0.05, 0.3, 0.8}) {
        const NormalChord chord{on_circle(-half), on_circle(half), on_circle(-half), on_circle(half), Vector3::UnitZ()};
        CHECK((virtual_point(chord) - Vector3(0, 0, 1)).norm() < 1e-14);
    }
}

TEST_CASE("the virtual point does not depend on the direction of the edge") {
    const Vector3 a(0.1, -0.2, 0.3);
    const Vector3 b(1.1, 0.4, 0.2);
    const Vector3 na = Vector3(-0.3, 0.1, 1).normalized();
    const Vector3 nb = Vector3(0.2, 0.3, 1).normalized();
    const Vector3 m(0.1, 0.2, 1.9);
    CHECK((virtual_point({a, b, na, nb, m}) - virtual_point({b, a, nb, na, m})).norm() < 1e-15);
}

TEST_CASE("the virtual point lies between its two circles") {
    // Tangents of angle α at a and β at b: the arcs' heights over the chord of length ℓ are (ℓ/2) tan(α/2), (ℓ/2)
    // tan(β/2).
    const double alpha = 0.4;
    const double beta = 0.1;
    const Vector3 na(-std::sin(alpha), 0, std::cos(alpha));
    const Vector3 nb(std::sin(beta), 0, std::cos(beta));
    const Vector3 p = virtual_point({{-1, 0, 0}, {1, 0, 0}, na, nb, Vector3::UnitZ()});
    CHECK(p.z() == doctest::Approx(0.5 * (std::tan(alpha / 2) + std::tan(beta / 2))));
    CHECK(p.x() == doctest::Approx(0.0));
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
