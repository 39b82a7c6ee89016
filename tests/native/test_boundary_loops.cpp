#include <doctest/doctest.h>

#include <cmath>

#include "boundary/fitted_boundary.h"
#include "boundary/surrounding_fit.h"
#include "shape/visible_join.h"

using namespace fairing;

namespace {

Vector3 leaning(double angle) { return {std::sin(angle), 0.0, std::cos(angle)}; }

// Fits of planes at points along y, with these normals (angles from z) and standard errors.
SurroundingFit row_of_planes(const std::vector<double>& angles, const std::vector<double>& errors) {
    SurroundingFit fit;
    const auto count = static_cast<Eigen::Index>(angles.size());
    fit.centres = Points::Zero(3, count);
    fit.averaged = Vector3::UnitZ().replicate(1, count);
    fit.lengths = VectorX::Ones(count);
    for (int k = 0; k < static_cast<int>(angles.size()); ++k) {
        fit.fits.emplace_back(SlopeFit{.normal = leaning(angles[k]), .error = errors[k]});
        fit.centres(1, k) = k;
        fit.first.push_back(k);
        if (k > 0) fit.edges.push_back({k - 1, k});
    }
    return fit;
}

double lean(const Vector3& normal) { return std::atan2(normal.x(), normal.z()); }

}  // namespace

TEST_CASE("two planes are reconciled as least squares say") {
    const double angle = 1e-4;
    const auto filtered = [&](double first, double second) {
        return filtered_normals(row_of_planes({0.0, angle}, {first, second}));
    };
    // μ = 16: the difference falls to 1/(1 + 16 (σ₁² + σ₂²)/(σ₁σ₂)), and each gives way by its variance.
    const Points alike = filtered(0.1, 0.1);
    CHECK(lean(alike.col(1)) - lean(alike.col(0)) == doctest::Approx(angle / 33.0).epsilon(1e-6));
    CHECK(lean(alike.col(0)) == doctest::Approx(angle * 16.0 / 33.0).epsilon(1e-6));
    const Points unlike = filtered(0.1, 0.02);
    CHECK(lean(unlike.col(1)) - lean(unlike.col(0)) == doctest::Approx(angle / (1.0 + 16.0 * 5.2)).epsilon(1e-6));
    CHECK(lean(unlike.col(0)) / (angle - lean(unlike.col(1))) == doctest::Approx(25.0).epsilon(1e-5));
}

TEST_CASE("fits that predict each other's normals are left alone") {
    const double curvature = 0.2;  // around x: y² terms, in units of scale 1
    SurroundingFit fit = row_of_planes({0.0, 0.0, 0.0}, {0.1, 0.03, 0.2});
    for (int k = 0; k < 3; ++k) {
        SlopeFit& here = *fit.fits[k];
        const double turn = std::asin(curvature * (k - 1.0));
        fit.centres.col(k) = Vector3(0.0, std::sin(turn), std::cos(turn)) / curvature;
        here.normal = Vector3(0.0, std::sin(turn), std::cos(turn));
        here.x = Vector3(0.0, std::cos(turn), -std::sin(turn));
        here.y = Vector3(-1.0, 0.0, 0.0);
        here.terms[0] = -0.5 * curvature;
    }
    const Points filtered = filtered_normals(fit);
    for (int k = 0; k < 3; ++k) CHECK((filtered.col(k) - fit.fits[k]->normal).norm() < 1e-12);
}

TEST_CASE("a vertex far off its fit, or without one, is bad; one without triangles is not") {
    SurroundingFit fit = row_of_planes(std::vector<double>(20, 0.0), std::vector<double>(20, 0.01));
    for (auto& here : fit.fits) here->height = 0.02;
    fit.fits[3]->height = -0.31;
    CHECK(bad_vertices(fit) == Indices{3});
    fit.lengths[3] = 2.0;  // edges twice as long
    CHECK(bad_vertices(fit).empty());
    fit.fits[5].reset();
    CHECK(bad_vertices(fit) == Indices{5});
    fit.lengths[5] = 0.0;
    CHECK(bad_vertices(fit).empty());
}
