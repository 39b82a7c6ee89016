#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "boundary/fair_border.h"
#include "boundary/least_variation_curve.h"

using namespace fairing;

namespace {

const VectorX shares = VectorX::LinSpaced(23, 0.0, 1.0);

// On a circle of radius 2 around the z axis, at these angles.
Points on_circle(const VectorX& angles) {
    Points result(3, angles.size());
    for (Eigen::Index k = 0; k < angles.size(); ++k)
        result.col(k) = 2.0 * Vector3(std::cos(angles[k]), std::sin(angles[k]), 0.0);
    return result;
}

Vector3 along_circle(double angle) { return {-std::sin(angle), std::cos(angle), 0.0}; }

// A point, its speed and the share of the length on a turn of a helix of radius and rise 1.
CurveEnd on_helix(double angle) {
    return {Vector3(std::cos(angle), std::sin(angle), 0.4 * angle), Vector3(-std::sin(angle), std::cos(angle), 0.4)};
}

}  // namespace

TEST_CASE("a helix and a parabola come back to 2e-3 of the chord, and the tangents hold") {
    const CurveEnd begin = on_helix(0.0);
    const CurveEnd end = on_helix(1.5);
    const Points curve = least_variation_curve(begin, end, shares);
    for (Eigen::Index k = 0; k < shares.size(); ++k)
        CHECK((curve.col(k) - on_helix(1.5 * shares[k]).place).norm() < 2e-3);
    const Points close = least_variation_curve(begin, end, VectorX::Constant(1, 1e-4));
    CHECK((close.col(0) - begin.place).normalized().dot(begin.direction.normalized()) > 1.0 - 1e-6);
    const auto on_parabola = [](double x) {
        return CurveEnd{Vector3(x, 0.0, 0.3 * x * x), Vector3(1.0, 0.0, 0.6 * x)};
    };
    const Points flat = least_variation_curve(on_parabola(0.0), on_parabola(1.0), shares);
    CHECK((flat.row(2).array() - 0.3 * flat.row(0).array().square()).abs().maxCoeff() < 2e-3);
}

TEST_CASE("ends in one place are refused") {
    const CurveEnd end{Vector3::Ones(), Vector3::UnitX()};
    CHECK_THROWS_AS(least_variation_curve(end, end, shares), std::invalid_argument);
}

TEST_CASE("a chain on a circle or a straight line tells its tangent and its curvature") {
    const VectorX angles = (VectorX(5) << 0.0, 0.05, 0.2, 0.26, 0.4).finished();
    const ChainEnd circle = end_of_chain(on_circle(angles));
    CHECK((circle.direction + along_circle(0.0)).norm() < 1e-12);
    CHECK((circle.curvature - Vector3(-0.5, 0.0, 0.0)).norm() < 1e-12);
    const Vector3 way(1.0, 2.0, -0.5);
    const ChainEnd line = end_of_chain(way * angles.transpose());
    CHECK((line.direction + way.normalized()).norm() < 1e-12);
    CHECK(line.curvature.norm() < 1e-12);
    const ChainEnd edge = end_of_chain(way * angles.head(2).transpose());
    CHECK((edge.direction + way.normalized()).norm() < 1e-12);
    CHECK(edge.curvature.norm() == 0.0);
}

TEST_CASE("a chain with noise of 0.02 edges tells its tangent to some degrees") {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 0.02);
    double worst = 0.0;
    for (int trial = 0; trial < 100; ++trial) {
        Points chain(3, 6);
        for (Eigen::Index k = 0; k < chain.size(); ++k) chain.data()[k] = noise(random);
        for (int k = 0; k < 6; ++k) chain(0, k) += k;
        worst = std::max(worst, std::acos(-end_of_chain(chain).direction.x()));
    }
    CHECK(worst < 0.1);
}
