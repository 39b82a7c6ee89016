#include <doctest/doctest.h>

#include <cmath>
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

}  // namespace

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
