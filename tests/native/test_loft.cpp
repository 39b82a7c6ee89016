#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "meshes.h"
#include "method/lofted.h"
#include "start/loft.h"

using namespace fairing;

namespace {

constexpr int around = 48;

// A round pipe along z of equilateral triangles.
test::Mesh pipe(int rows) {
    const double height = std::numbers::sqrt3 * std::numbers::pi / around;
    test::Mesh mesh{Points(3, around * (rows + 1)), Triangles(3, 2 * around * rows)};
    for (int r = 0; r <= rows; ++r) {
        for (int c = 0; c < around; ++c) {
            const double angle = 2.0 * std::numbers::pi * (c + 0.5 * r) / around;
            mesh.points.col(r * around + c) << std::cos(angle), std::sin(angle), height * r;
        }
    }
    Eigen::Index t = 0;
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < around; ++c) {
            const int a = r * around + c;
            const int b = r * around + (c + 1) % around;
            mesh.triangles.col(t++) << a, b, a + around;
            mesh.triangles.col(t++) << b, b + around, a + around;
        }
    }
    return mesh;
}

// Its ends lean outwards by `lean`, like trumpets.
struct Pipe {
    test::Single single;
    Problem problem;

    explicit Pipe(int rows, double lean = 0.0)
        : single(test::single_patch(pipe(rows))), problem{single.patch(), {}, {}, uniform_weights(single.patch()), {}} {
        const Eigen::Index fixed = single.points.cols() - single.patch().free_count;
        problem.fixed_points = single.points.rightCols(fixed);
        problem.fixed_normals = problem.fixed_points;
        const double middle = 0.5 * problem.fixed_points.row(2).maxCoeff();
        for (auto normal : problem.fixed_normals.colwise()) {
            const double side = normal[2] < middle ? 1.0 : -1.0;
            normal *= std::cos(lean);
            normal[2] = side * std::sin(lean);
        }
    }
    [[nodiscard]] Points with(const Points& free) const {
        Points points = single.points;
        points.leftCols(free.cols()) = free;
        return points;
    }
    [[nodiscard]] double area(const Points& points) const {
        FaceGeometry faces;
        faces.update(points, single.patch().triangles);
        return faces.areas.sum();
    }
};

double least_radius(const Points& free) { return free.topRows(2).colwise().norm().minCoeff(); }

}  // namespace

TEST_CASE("the lines and the bulge of a loft over a pipe have the radii of closed forms") {
    const Pipe pipe(40);
    for (const double roundness : {0.6, 1.5}) {
        const double a = 0.5 * roundness;
        const auto fill = loft(pipe.problem, roundness, Progress());
        REQUIRE(fill);
        CHECK(least_radius(fill->flat) == doctest::Approx(1.0 / std::cosh(a)).epsilon(2e-3));
        const double clamped =
            (std::sinh(a) + a * std::cosh(a)) / (std::sinh(a) * std::cosh(a) + a);  // of r'''' − 2 k² r'' + k⁴ r = 0
        CHECK(least_radius(fill->flat + fill->bulge) == doctest::Approx(clamped).epsilon(2e-3));
    }
}

TEST_CASE("slopes are let go where the normals turn along the outline") {
    Pipe pipe(20, 0.5);
    const Points before = loft(pipe.problem, 0.6, Progress())->bulge;
    for (Eigen::Index k = 0; k < pipe.problem.fixed_normals.cols(); k += 2) {
        const Vector3 radial = pipe.problem.fixed_points.col(k).cwiseProduct(Vector3(1.0, 1.0, 0.0));
        pipe.problem.fixed_normals.col(k) = -pipe.problem.fixed_normals.col(k) + 0.2 * radial;
        pipe.problem.fixed_normals.col(k).normalize();
    }
    const Points after = loft(pipe.problem, 0.6, Progress())->bulge;
    CHECK(before.cwiseAbs().maxCoeff() > 0.05);
    CHECK(after.cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a loft whose slopes make a balloon lets them go") {
    const Pipe pipe(60, -1.3);
    const auto fill = loft(pipe.problem, 0.6, Progress());
    REQUIRE(fill);
    const double least = pipe.area(pipe.with(fill->flat));
    REQUIRE(pipe.area(pipe.with(fill->flat + fill->bulge)) > 2.0 * least);
    const auto solution = lofted(pipe.problem, {}, Progress());
    REQUIRE(solution);
    CHECK(solution->instead == Instead::loft);
    CHECK(pipe.area(solution->points) <= 2.0 * least);
    CHECK(pipe.area(solution->points) > 1.1 * least);
}

TEST_CASE("one outline, and vertices held elsewhere, have no loft") {
    const test::Single disc = test::single_patch(test::grid(8, 0.2, test::flat));
    const Points fixed = disc.points.rightCols(disc.points.cols() - disc.patch().free_count);
    const Points up = Vector3::UnitZ().replicate(1, fixed.cols());
    CHECK_FALSE(loft({disc.patch(), fixed, up, uniform_weights(disc.patch()), {}}, 0.6, Progress()));

    const test::Mesh mesh = pipe(10);
    std::vector<char> given(static_cast<std::size_t>(mesh.points.cols()), 0);
    given[5 * around] = 1;
    const test::Single held = test::single_patch(mesh, given);
    const Points outline = held.points.rightCols(held.points.cols() - held.patch().free_count);
    CHECK_FALSE(loft({held.patch(), outline, outline, uniform_weights(held.patch()), {}}, 0.6, Progress()));
}
