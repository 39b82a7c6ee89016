#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/slope_fit.h"

using namespace fairing;

namespace {

// A grid on one side of the origin, x ≥ 0, `size` wide, on z = height(x, y).
template <typename Height>
std::vector<Vector3> half_grid(double size, int rows, int columns, const Height& height) {
    std::vector<Vector3> points;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            if (i == 0 && j == columns / 2) continue;
            const double x = size * i / rows;
            const double y = size * (j - columns / 2) / columns;
            points.emplace_back(x, y, height(x, y));
        }
    }
    return points;
}

const Vector3 tilted = Vector3(-0.1, 0.05, 1.0).normalized();

double error(const std::vector<Vector3>& points, Degree degree) {
    const auto fit = fit_slopes(Vector3::Zero(), points, tilted, degree);
    REQUIRE(fit.has_value());
    return (fit->normal - Vector3::UnitZ()).norm();
}

}  // namespace

TEST_CASE("slopes from one side are found to second order by quadratic terms, to third by cubic ones") {
    const auto wavy = [](double x, double y) {
        return std::sin(x) * std::sin(x) + 0.3 * x * y + 0.2 * y * y * y * y + 0.4 * x * x * x;
    };
    const auto at_size = [&](double size, Degree degree) { return error(half_grid(size, 6, 5, wavy), degree); };
    CHECK(at_size(0.1, Degree::cubic) < 1e-3);
    CHECK(at_size(0.1, Degree::cubic) / at_size(0.05, Degree::cubic) > 6.0);
    CHECK(at_size(0.1, Degree::quadratic) / at_size(0.05, Degree::quadratic) > 3.0);
    CHECK(at_size(0.1, Degree::quadratic) > 3.0 * at_size(0.1, Degree::cubic));
}

TEST_CASE("spheres and cylinders are met exactly, however far around the points reach") {
    const auto sphere = [](double x, double y) { return std::sqrt(1.0 - x * x - y * y) - 1.0; };
    std::vector<Vector3> cylinder;  // axis in a direction of no coordinate, points to 70° around
    const Vector3 axis(0.6, 0.8, 0.0);
    const Vector3 across(-0.8, 0.6, 0.0);
    for (int i = 0; i <= 4; ++i) {
        for (int j = -3; j <= 3; ++j) {
            if (i == 0 && j == 0) continue;
            const double angle = j * 70.0 / 3.0 * std::numbers::pi / 180.0;
            cylinder.push_back(0.7 * i * axis + std::sin(angle) * across + (std::cos(angle) - 1.0) * Vector3::UnitZ());
        }
    }
    for (const Degree degree : {Degree::quadratic, Degree::cubic}) {
        CHECK(error(half_grid(1.0, 6, 5, sphere), degree) < 1e-11);
        CHECK(error(cylinder, degree) < 1e-11);
    }
}

TEST_CASE("the error of a fit tells what its points determine") {
    const auto cubic = [](double x, double y) { return 0.5 * x * x * x + y * y; };
    const auto fitted = [&](int rows, Degree degree) {
        return fit_slopes(Vector3::Zero(), half_grid(0.1, rows, 9, cubic), tilted, degree);
    };
    // Six rows show x, x² and x³.
    CHECK(fitted(6, Degree::cubic)->error < 0.25 * fitted(6, Degree::quadratic)->error);
    // Two rows beside the origin's don't.
    CHECK_FALSE(fitted(3, Degree::cubic).has_value());
    CHECK(fitted(3, Degree::quadratic).has_value());
}

TEST_CASE("nothing is fitted to points that don't determine a plane, or too few") {
    std::vector<Vector3> line;
    for (int k = 1; k < 20; ++k) line.emplace_back(0.1 * k, 0.0, 0.0);
    CHECK_FALSE(fit_slopes(Vector3::Zero(), line, Vector3::UnitZ(), Degree::quadratic).has_value());
    const auto flat = half_grid(1.0, 3, 3, [](double, double) { return 0.0; });
    CHECK(fit_slopes(Vector3::Zero(), flat, Vector3::UnitZ(), Degree::quadratic).has_value());
    CHECK_FALSE(fit_slopes(Vector3::Zero(), std::span(flat).first(5), Vector3::UnitZ(), Degree::quadratic).has_value());
    CHECK_FALSE(fit_slopes(Vector3::Zero(), flat, Vector3::UnitZ(), Degree::cubic).has_value());
    CHECK_FALSE(fit_slopes(Vector3::Zero(), flat, Vector3::Zero(), Degree::quadratic).has_value());
    const std::vector<Vector3> coincident(8, Vector3::Zero());
    CHECK_FALSE(fit_slopes(Vector3::Zero(), coincident, Vector3::UnitZ(), Degree::quadratic).has_value());
}

TEST_CASE("a fit that leads far from its start is none") {
    const auto steep = half_grid(1.0, 4, 5, [](double x, double) { return 5.0 * x; });
    CHECK_FALSE(fit_slopes(Vector3::Zero(), steep, Vector3::UnitZ(), Degree::quadratic).has_value());
    const Vector3 normal = Vector3(-5.0, 0.0, 1.0).normalized();
    const auto fit = fit_slopes(Vector3::Zero(), steep, normal, Degree::quadratic);
    REQUIRE(fit.has_value());
    CHECK((fit->normal - normal).norm() < 1e-12);
}

TEST_CASE("a free centre may lie off the surface, and the fit tells how far") {
    const auto sphere = [](double x, double y) { return std::sqrt(1.0 - x * x - y * y) - 1.0; };
    const Vector3 lifted(0.0, 0.0, 0.02);
    for (const double unit : {1.0, 1000.0}) {
        std::vector<Vector3> points = half_grid(0.5, 6, 9, sphere);
        for (Vector3& point : points) point *= unit;
        const auto free = fit_slopes(unit * lifted, points, tilted, Degree::quadratic, Centre::free);
        const auto met = fit_slopes(unit * lifted, points, tilted, Degree::quadratic);
        REQUIRE(free.has_value());
        REQUIRE(met.has_value());
        CHECK((free->normal - Vector3::UnitZ()).norm() < 0.5 * (met->normal - Vector3::UnitZ()).norm());
        CHECK(free->height / unit < -0.01);
        CHECK(free->height / unit > -0.02);
        CHECK(met->height == 0.0);
    }
}

TEST_CASE("with a free centre spheres and cylinders are still exact, and all of their normals are predicted") {
    const auto sphere = [](double x, double y) { return std::sqrt(1.0 - x * x - y * y) - 1.0; };
    const auto cylinder = [](double x, double) { return std::sqrt(1.0 - x * x) - 1.0; };
    for (const Degree degree : {Degree::quadratic, Degree::cubic}) {
        const auto round = fit_slopes(Vector3::Zero(), half_grid(0.8, 6, 5, sphere), tilted, degree, Centre::free);
        const auto tube = fit_slopes(Vector3::Zero(), half_grid(0.8, 6, 5, cylinder), tilted, degree, Centre::free);
        REQUIRE(round.has_value());
        REQUIRE(tube.has_value());
        CHECK((round->normal - Vector3::UnitZ()).norm() < 1e-11);
        CHECK((tube->normal - Vector3::UnitZ()).norm() < 1e-11);
        CHECK(std::abs(round->height) < 1e-12);
        for (const double x : {-0.4, 0.3, 0.6}) {
            const Vector3 offset(x, 0.1, cylinder(x, 0.1));
            CHECK((tube->normal_at(offset) - Vector3(x, 0.0, 1.0 + offset.z())).norm() < 1e-10);
            const Vector3 beside(x, 0.0, sphere(x, 0.0));
            CHECK((round->normal_at(beside) - Vector3(x, 0.0, 1.0 + beside.z())).norm() < 1e-10);
        }
    }
}

TEST_CASE("noise: the standard error is what the normals err by, the scatter is the noise") {
    const double noise = 0.01;
    double squared_angle = 0.0;
    double squared_error = 0.0;
    double squared_scatter = 0.0;
    double squared_by_met = 0.0;
    constexpr unsigned trials = 200;
    for (unsigned seed = 0; seed < trials; ++seed) {
        std::mt19937 random(seed);
        std::normal_distribution<double> normal(0.0, noise);
        const auto bowl = [&](double x, double y) { return 0.3 * x * x + 0.1 * x * y - 0.2 * y * y + normal(random); };
        const std::vector<Vector3> points = half_grid(1.0, 5, 7, bowl);
        const Vector3 centre(0.0, 0.0, normal(random));
        const auto free = fit_slopes(centre, points, tilted, Degree::quadratic, Centre::free);
        const auto met = fit_slopes(centre, points, tilted, Degree::quadratic);
        REQUIRE(free.has_value());
        REQUIRE(met.has_value());
        squared_angle += (free->normal - Vector3::UnitZ()).squaredNorm();
        squared_by_met += (met->normal - Vector3::UnitZ()).squaredNorm();
        squared_error += free->error * free->error;
        squared_scatter += free->scatter * free->scatter;
    }
    CHECK(std::sqrt(squared_angle / squared_error) == doctest::Approx(1.0).epsilon(0.3));
    CHECK(std::sqrt(squared_scatter / trials) == doctest::Approx(noise).epsilon(0.3));
    CHECK(squared_by_met > 1.5 * squared_angle);
}
