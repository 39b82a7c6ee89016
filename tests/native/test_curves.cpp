#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>

#include "outline/chain_end.h"
#include "outline/least_variation_curve.h"

using namespace fairing;

namespace {

constexpr double pi = std::numbers::pi;

const VectorX shares = VectorX::LinSpaced(23, 0.0, 1.0);

// On a circle of radius 2 around the z axis, at these angles.
Points on_circle(const VectorX& angles) {
    Points result(3, angles.size());
    for (Eigen::Index k = 0; k < angles.size(); ++k)
        result.col(k) = 2.0 * Vector3(std::cos(angles[k]), std::sin(angles[k]), 0.0);
    return result;
}

Vector3 along_circle(double angle) { return {-std::sin(angle), std::cos(angle), 0.0}; }

double largest(const Points& difference) { return difference.colwise().norm().maxCoeff(); }

// A point, its speed and the share of the length on a turn of a helix of radius and rise 1.
CurveEnd on_helix(double angle) {
    return {Vector3(std::cos(angle), std::sin(angle), 0.4 * angle), Vector3(-std::sin(angle), std::cos(angle), 0.4)};
}

}  // namespace

TEST_CASE("a straight line comes back") {
    const Vector3 way(1.0, 2.0, -0.5);
    const Points curve = least_variation_curve({Vector3::Zero(), way}, {3.0 * way, way}, shares);
    CHECK(largest(curve - 3.0 * way * shares.transpose()) < 1e-12);
}

TEST_CASE("a circle comes back, from both tangents and from one, up to 4/3 of a half turn") {
    for (const double angle : {0.3, 1.0, 0.5 * pi, pi, 4.0 / 3.0 * pi}) {
        CAPTURE(angle);
        const CurveEnd begin{on_circle(VectorX::Zero(1)).col(0), along_circle(0.0)};
        const CurveEnd end{on_circle(VectorX::Constant(1, angle)).col(0), along_circle(angle)};
        const Points exact = on_circle(angle * shares);
        CHECK(largest(least_variation_curve(begin, end, shares) - exact) < 1e-9);
        CHECK(largest(least_variation_curve(begin, {end.place, Vector3::Zero()}, shares) - exact) < 1e-9);
        CHECK(largest(least_variation_curve({begin.place, Vector3::Zero()}, end, shares) - exact) < 1e-9);
    }
}

TEST_CASE("a curve moves, turns and scales with its ends, and does not know its direction") {
    const CurveEnd begin{Vector3(0.1, 0.0, 0.3), Vector3(1.0, 0.4, 0.2)};
    const CurveEnd end{Vector3(1.0, 0.5, 0.0), Vector3(0.7, -0.3, 0.4)};
    const Points curve = least_variation_curve(begin, end, shares);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.0, Vector3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    const Vector3 shift(5.0, -2.0, 1.0);
    const double factor = 1000.0;
    const auto moved = [&](const CurveEnd& from) {
        return CurveEnd{factor * turn * from.place + shift, turn * from.direction};
    };
    const Points image = (factor * turn * curve).colwise() + shift;
    CHECK(largest(least_variation_curve(moved(begin), moved(end), shares) - image) < 1e-7 * factor);
    const Points back =
        least_variation_curve({end.place, -end.direction}, {begin.place, -begin.direction}, shares).rowwise().reverse();
    CHECK(largest(back - curve) < 1e-7);
    CHECK(largest(curve.leftCols(1) - begin.place) < 1e-15);
    CHECK(largest(curve.rightCols(1) - end.place) < 1e-15);
}

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
