#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "method/blemishes.h"
#include "pipes.h"
#include "start/protrusions.h"

using namespace fairing;

namespace {

constexpr int rows = 40;

// A pipe whose upper end is closed by a fan around a pole.
test::Mesh capped_pipe() {
    test::Mesh mesh = test::pipe(rows);
    const auto pole = static_cast<int>(mesh.points.cols());
    const Eigen::Index count = mesh.triangles.cols();
    mesh.points.conservativeResize(3, pole + 1);
    mesh.points.col(pole) << 0.0, 0.0, mesh.points(2, pole - 1) * (rows + 1) / rows;
    mesh.triangles.conservativeResize(3, count + test::around);
    for (int c = 0; c < test::around; ++c)
        mesh.triangles.col(count + c) << pole - test::around + c, pole - test::around + (c + 1) % test::around, pole;
    return mesh;
}

// Surfaces of revolution over one connectivity: radius and height by s, 0 at the pole and 1 on the outline.
using Profile = std::function<std::pair<double, double>(double)>;

struct Revolved : test::Pipe {
    Revolved() : Pipe(capped_pipe(), 0.0) {}
    [[nodiscard]] Points shaped(const Profile& profile) const {
        const double top = single.points.row(2).maxCoeff();
        Points points = single.points;
        for (auto point : points.colwise()) {
            const auto [radius, height] = profile(1.0 - point[2] / top);
            point.head<2>() *= radius;
            point[2] = height;
        }
        return points;
    }
    // How blunt a finger on a plane is against another.
    [[nodiscard]] Blemishes changed(const Profile& before, const Profile& after) {
        problem.before = shaped(before);
        return BlemishFinder(problem, *problem.before, Progress()).in(shaped(after));
    }
};

Profile cone(double half_angle) {
    return [=](double s) { return std::pair(s * std::sin(half_angle), -s * std::cos(half_angle)); };
}

Profile finger(double radius, double length) {
    constexpr double tip = 0.15;
    constexpr double root = 0.6;
    return [=](double s) {
        if (s < tip) return std::pair(radius * s / tip, length);
        if (s < root) return std::pair(radius, length * (root - s) / (root - tip));
        return std::pair(radius + (1.0 - radius) * (s - root) / (1.0 - root), 0.0);
    };
}

}  // namespace

TEST_CASE("caps of cones are as blunt as the tangent of their half-angle") {
    const Revolved disc;
    const auto caps = Protrusions::of(disc.single.patch(), Progress());
    REQUIRE(caps);
    REQUIRE(caps->count() > 15);
    const VectorX flat = caps->bluntness(disc.shaped(cone(0.5 * std::numbers::pi)));
    CHECK(flat.minCoeff() > 0.99);
    CHECK(flat.maxCoeff() < 1.1);  // a rim runs up to a row beyond the last vertices
    for (const double angle : {0.7, 0.4, 0.1}) {
        const VectorX blunt = caps->bluntness(disc.shaped(cone(angle)));
        CHECK(blunt.minCoeff() == doctest::Approx(std::tan(angle)).epsilon(0.01));
        CHECK(blunt.maxCoeff() == doctest::Approx(std::tan(angle)).epsilon(0.01));
    }
    const Points wide = 3.0 * disc.shaped(cone(0.4));
    CHECK(caps->reaches(wide).isApprox(3.0 * caps->reaches(disc.shaped(cone(0.4)))));
    CHECK(caps->bluntness(wide).isApprox(caps->bluntness(disc.shaped(cone(0.4)))));
}

TEST_CASE("a pipe open at both ends has no caps") {
    const test::Pipe pipe(20);
    const auto caps = Protrusions::of(pipe.single.patch(), Progress());
    REQUIRE(caps);
    CHECK(caps->count() == 0);
}
