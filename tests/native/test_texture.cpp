#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "texture/graded_mesh.h"
#include "texture/harmonic_extension.h"
#include "texture/texel_owners.h"

using namespace fairing;

namespace {

// The unit square, cut along a diagonal.
struct Square {
    Points points;
    Triangles triangles;
};

Square square() {
    Square made{Points(3, 4), Triangles(3, 2)};
    made.points << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
    made.triangles << 0, 0, 1, 2, 2, 3;
    return made;
}

Eigen::Matrix2Xd corners_of(const Square& mesh, double size) {
    Eigen::Matrix2Xd corners(2, mesh.triangles.size());
    for (Eigen::Index k = 0; k < corners.cols(); ++k)
        corners.col(k) = size * mesh.points.col(mesh.triangles(k)).head<2>();
    return corners;
}

}  // namespace

TEST_CASE("a square's texels are those of its two triangles, also where they lie on the diagonal") {
    const TexelOwners found = texel_owners(corners_of(square(), 8.0), {8, 8});
    CHECK(found.count == 64);
    int first = 0;
    for (const int owner : found.owner) {
        CHECK(owner != none);
        first += owner == 0 ? 1 : 0;
    }
    CHECK((first == 28 || first == 36));  // the diagonal's eight are all on one side
}

TEST_CASE("texels beyond an image come in on its other side, and what is vast covers all") {
    const TexelOwners found = texel_owners(corners_of(square(), 8.0).array() - 5.0, {7, 9});
    CHECK(found.count == 64);
    CHECK(std::count(found.owner.begin(), found.owner.end(), none) == 7);
    CHECK(texel_owners(corners_of(square(), 1e9).array() - 5e8, {7, 9}).count == 2 * 63);
    CHECK(texel_owners(Eigen::Matrix2Xd::Constant(2, 3, NAN), {7, 9}).count == 0);
}

TEST_CASE("values of texels are linear in a triangle") {
    const Eigen::Matrix2Xd corners = corners_of(square(), 8.0);
    const Eigen::MatrixXf found = texel_values(corners, corners.row(0) - 2.0 * corners.row(1), {8, 8});
    for (int k = 0; k < 64; ++k) CHECK(found(0, k) == doctest::Approx((k % 8 + 0.5) - 2.0 * (k / 8 + 0.5)));
}

TEST_CASE("a graded mesh is short along its chosen side, long away from it, and the same square") {
    const Square mesh = square();
    ChosenSides chosen = ChosenSides::Constant(3, 2, false);
    chosen(0, 0) = true;  // y = 0
    const GradedMesh found = graded_mesh(mesh.points, mesh.triangles, chosen, 0.01);
    double along = 0.0;
    double longest = 0.0;
    double area = 0.0;
    for (int t = 0; t < static_cast<int>(found.triangles.cols()); ++t) {
        std::array<Vector3, 3> at;
        for (int k = 0; k < 3; ++k) {
            at[k] = found.points.col(found.triangles(k, t));
            Vector3 again = Vector3::Zero();
            for (int j = 0; j < 3; ++j)
                again += found.weights(j, 3 * t + k) * mesh.points.col(mesh.triangles(j, found.parent[t]));
            CHECK((again - at[k]).norm() < 1e-12);
        }
        area += 0.5 * (at[1] - at[0]).cross(at[2] - at[0]).z();
        for (int k = 0; k < 3; ++k) {
            const double length = (at[(k + 1) % 3] - at[k]).norm();
            longest = std::max(longest, length);
            if (!found.chosen(k, t)) continue;
            CHECK(at[k].y() == 0.0);
            CHECK(length <= 0.01);
            along += length;
        }
    }
    CHECK(along == doctest::Approx(1.0));
    CHECK(area == doctest::Approx(1.0));
    CHECK(longest > 0.1);
    CHECK(found.triangles.cols() < 8000);  // 32,768 if all were as short
}

TEST_CASE("harmonic values between two sides are linear, and there are none without a known vertex") {
    const Square mesh = square();
    ChosenSides chosen = ChosenSides::Constant(3, 2, false);
    chosen(0, 0) = true;
    const GradedMesh fine = graded_mesh(mesh.points, mesh.triangles, chosen, 0.05);
    Indices known;
    for (int v = 0; v < static_cast<int>(fine.points.cols()); ++v) {
        if (fine.points(1, v) == 0.0 || fine.points(1, v) == 1.0) known.push_back(v);
    }
    Eigen::MatrixXd given(static_cast<Eigen::Index>(known.size()), 1);
    for (int k = 0; k < static_cast<int>(known.size()); ++k) given(k, 0) = 3.0 * fine.points(1, known[k]);
    const Eigen::MatrixXd found = harmonic_extension(fine.points, fine.triangles, known, given);
    CHECK((found.transpose() - 3.0 * fine.points.row(1)).cwiseAbs().maxCoeff() < 1e-6);
    CHECK(harmonic_extension(fine.points, fine.triangles, {}, Eigen::MatrixXd(0, 1)).array().isNaN().all());
}
