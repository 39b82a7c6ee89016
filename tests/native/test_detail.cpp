#include <doctest/doctest.h>

#include <numbers>

#include <Eigen/Geometry>

#include "detail/old_base.h"
#include "detail/skin.h"
#include "detail/turn.h"
#include "meshes.h"

using namespace fairing;

namespace {

Eigen::Matrix3d some_rotation() {
    return Eigen::AngleAxisd(2.0, Vector3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
}

Vector3 wavy(double u, double v) { return {u, v, 0.02 * std::sin(31.0 * u + 2.0) * std::sin(40.0 * v)}; }

Points outline_of(const test::Single& single) {
    return single.points.rightCols(single.patch().vertex_count() - single.patch().free_count);
}

// A patch with detail, none at its outline unless that is moved; wavelength in its own units.
struct Skinned {
    test::Single single;
    Points outline;
    std::unique_ptr<Skin> skin;

    Skinned(const test::Mesh& mesh, double wavelength, const Vector3& shift = Vector3::Zero())
        : single(test::single_patch(mesh)),
          outline(outline_of(single).colwise() + shift),
          skin(Skin::read(single.patch(), {single.points, outline}, wavelength, Progress())) {}

    [[nodiscard]] Points detail() const { return (single.points - skin->base()).leftCols(single.patch().free_count); }
    [[nodiscard]] double error(const Points& new_base, const Points& expected) const {
        return error(new_base, expected, outline_of(single) - outline);
    }
    [[nodiscard]] double error(const Points& new_base, const Points& expected, const Points& at_outline) const {
        return (skin->detail_on(new_base, at_outline) - expected).cwiseAbs().maxCoeff();
    }
};

Points smoothed(const test::Single& single, double wavelength) {
    const Points outline = outline_of(single);
    return *old_base(single.patch(), test::stiffness_of(single), {single.points, outline}, wavelength, Progress());
}

}  // namespace

TEST_CASE("a triangle's turn is the rotation next to its map") {
    Eigen::Matrix3d from;
    from << 0.1, 1.2, 0.3, 0.0, 0.2, 0.9, 0.5, 0.4, 0.7;
    const Eigen::Matrix3d rotation = some_rotation();
    CHECK(turn_of_triangle(from, 3.0 * rotation * from).isApprox(rotation, 1e-14));
    // A stretch along two axes in the triangle's plane is symmetric and turns nothing, wherever the first side points.
    const Vector3 normal = (from.col(1) - from.col(0)).cross(Vector3(from.col(2) - from.col(0))).normalized();
    const Vector3 along = (0.3 * from.col(0) - 0.8 * from.col(1) + 0.5 * from.col(2)).normalized();
    const Vector3 across = normal.cross(along);
    const Eigen::Matrix3d stretch =
        normal * normal.transpose() + 2.0 * along * along.transpose() + 0.4 * across * across.transpose();
    CHECK(turn_of_triangle(from, rotation * stretch * from).isApprox(rotation, 1e-13));
}

TEST_CASE("a triangle without area turns nothing") {
    Eigen::Matrix3d needle;
    needle << 0.0, 1.0, 2.0, 0.0, 1.0, 2.0, 0.0, 0.0, 0.0;
    CHECK(turn_of_triangle(needle, Eigen::Matrix3d::Identity()).isIdentity(0.0));
    CHECK(turn_of_triangle(Eigen::Matrix3d::Identity(), needle).isIdentity(0.0));
}

TEST_CASE("on the old base the old patch comes back") {
    const Skinned skinned(test::grid(24, 0.3, wavy), 0.4);
    REQUIRE(skinned.detail().norm() > 0.1);
    CHECK(skinned.error(skinned.skin->base(), skinned.detail()) < 1e-12);
}

TEST_CASE("detail turns with its base, and keeps its size when that grows") {
    const Skinned skinned(test::grid(24, 0.3, wavy), 0.4);
    const Eigen::Matrix3d rotation = some_rotation();
    const Points moved = (2.5 * rotation * skinned.skin->base()).colwise() + Vector3(3.0, 1.0, -2.0);
    CHECK(skinned.error(moved, rotation * skinned.detail()) < 1e-12);
}

TEST_CASE("detail stands on a sheet rolled up as it stood on the flat one") {
    const auto ripple = [](double u, double v) {
        return Vector3(u, v, 0.16 * u * (1.0 - u) * v * (1.0 - v) * std::sin(50.0 * u) * std::sin(50.0 * v));
    };
    const Skinned skinned(test::grid(60, 0.1, ripple), 0.3);
    const Points& base = skinned.skin->base();
    const Points detail = skinned.detail();
    // Round a cylinder whose radius is 100 times the height; its frame turns by one radian in all.
    Points rolled(3, base.cols());
    Points expected(3, detail.cols());
    for (int v = 0; v < base.cols(); ++v) {
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(base(0, v), Vector3::UnitY()).toRotationMatrix();
        rolled.col(v) = turn.col(2) * (1.0 + base(2, v)) + base(1, v) * Vector3::UnitY();
        if (v < expected.cols()) expected.col(v) = turn * detail.col(v);
    }
    CHECK(skinned.error(rolled, expected) < 0.05 * detail.cwiseAbs().maxCoeff());
}

TEST_CASE("a plane has no detail, however its vertices lie and at whatever slope") {
    const auto slope = [](double u, double v) { return Vector3(u, v, 0.7 * u - 0.2 * v); };
    const test::Single single = test::single_patch(test::grid(20, 0.3, slope));
    CHECK((smoothed(single, 0.3) - single.points).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a sphere has next to none, up to its outline") {
    const test::Single single = test::single_patch(test::grid(40, 0.1, test::sphere, false));
    // 1 − F is 2·10⁻⁴ for the wavelength 0.3 and the sphere's own of 2π/√2.
    CHECK((smoothed(single, 0.3) - single.points).cwiseAbs().maxCoeff() < 2e-4);
}

TEST_CASE("what the new base turns over is distinguished from what was turned over before") {
    const auto overhang = [](double u, double v) {
        const double x = u - 0.5;
        const double y = v - 0.5;
        const double near = std::exp(-60.0 * (x * x + y * y));
        return Vector3(u + 0.25 * near, v, 0.1 * near);
    };
    const Skinned skinned(test::grid(40, 0.0, overhang), 0.8);
    const Points& base = skinned.skin->base();
    CHECK(skinned.skin->turned_over(base, skinned.single.points).empty());
    Points mirrored = skinned.single.points;
    mirrored.row(0) *= -1.0;
    CHECK(skinned.skin->turned_over(base, mirrored).size() > 1000);
}
