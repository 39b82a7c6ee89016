#include <doctest/doctest.h>

#include "geometry/face_geometry.h"
#include "geometry/target_surface.h"
#include "meshes.h"
#include "variation/least_variation.h"
#include "variation/lift.h"
#include "variation/newton.h"

using namespace fairing;

namespace {

// A patch of a surface with known normals, as a problem whose outline is exact.
struct Exact {
    test::Single single;
    Sheet sheet;
    Problem problem;

    Exact(const test::Mesh& mesh, const std::function<Vector3(const Vector3&)>& normal)
        : single(test::single_patch(mesh)),
          sheet{single.points, Points(3, single.points.cols())},
          problem{single.patch(), {}, {}, uniform_weights(single.patch()), {}} {
        for (Eigen::Index v = 0; v < sheet.points.cols(); ++v) sheet.normals.col(v) = normal(sheet.points.col(v));
        const Eigen::Index fixed = sheet.points.cols() - single.patch().free_count;
        problem.fixed_points = sheet.points.rightCols(fixed);
        problem.fixed_normals = sheet.normals.rightCols(fixed);
    }

    [[nodiscard]] double merit(Measure measure) const {
        return VariationEnergy(problem, Moving::points_and_normals, measure).measured(sheet).merit;
    }
};

constexpr double wide = 2.0;  // radii of a torus
constexpr double thin = 0.7;

Vector3 torus(double u, double v) {
    const double around = wide + thin * std::cos(v);
    return {around * std::cos(u), around * std::sin(u), thin * std::sin(v)};
}

Vector3 torus_normal(const Vector3& p) {
    const Vector3 axis = wide * Vector3(p.x(), p.y(), 0.0).normalized();
    return (p - axis).normalized();
}

Exact torus_patch(int n) { return {test::grid(n, 0.25, torus), torus_normal}; }

// ∫ (9/16) b² dA over the unit square of angles, b the derivative of the curvature around along the tube.
double variation_of_torus() {
    constexpr int steps = 2000;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double u = (k + 0.5) / steps;
        const double around = wide + thin * std::cos(u);
        const double b = std::sin(u) * wide / (around * around * thin);
        sum += 9.0 / 16.0 * b * b * thin * around / steps;
    }
    return sum;
}

}  // namespace

TEST_CASE("on irregular meshes the sum converges to the integral over the torus") {
    const double exact = variation_of_torus();
    const double coarse = std::abs(torus_patch(12).merit(Measure::plain) / exact - 1.0);
    const double fine = std::abs(torus_patch(48).merit(Measure::plain) / exact - 1.0);
    CHECK(fine < 1e-3);
    CHECK(fine < 0.2 * coarse);
}

TEST_CASE("derivatives are those of differences") {
    Exact exact = torus_patch(6);
    exact.problem.normal_weights = VectorX::Constant(exact.problem.fixed_points.cols(), 0.3);
    for (const Measure measure : {Measure::plain, Measure::scale_free}) {
        const VariationEnergy energy(exact.problem, Moving::points_and_normals, measure);
        const VectorX bump = 1e-2 * (1.7 * VectorX::LinSpaced(energy.unknowns().count(), 0.0, 99.0)).array().sin();
        const Sheet sheet = energy.moved(exact.sheet, bump, 1.0);
        QuadraticModel model;
        const SheetMerit present = energy.measured(sheet);
        energy.update(sheet, present, model);
        CHECK((energy.gradient(sheet, present) - model.gradient).norm() < 1e-12 * model.gradient.norm());
        const auto merit = [&](const VectorX& motion, double step) {
            return energy.measured(energy.moved(sheet, motion, step)).merit;
        };
        for (int k = 0; k < energy.unknowns().count(); k += 5) {
            const VectorX motion = VectorX::Unit(energy.unknowns().count(), k);
            const double step = 1e-6;
            const double slope = (merit(motion, step) - merit(motion, -step)) / (2.0 * step);
            CHECK(model.gradient[k] ==
                  doctest::Approx(slope).epsilon(1e-5).scale(model.gradient.cwiseAbs().maxCoeff()));
        }
    }
}
