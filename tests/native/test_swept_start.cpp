#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/flips.h"
#include "meshes.h"
#include "start/swept_start.h"

using namespace fairing;

namespace {

constexpr int around = 24;
constexpr int rows = 40;
constexpr double thin = 0.3;

Vector3 half_torus(double s, double u) {
    const double along = std::numbers::pi * s;
    const double angle = 2.0 * std::numbers::pi * u;
    const Vector3 out(std::cos(along), std::sin(along), 0.0);
    return out + thin * (std::cos(angle) * out + std::sin(angle) * Vector3::UnitZ());
}

// Quads whose diagonals run at random. The first row begins `begin` turns from u = 0, the last one `twist` turns
// further.
test::Mesh half_ring(unsigned seed, double begin, double twist = 0.0) {
    std::mt19937 random(seed);
    test::Mesh mesh{Points(3, around * (rows + 1)), Triangles(3, 2 * around * rows)};
    for (int r = 0; r <= rows; ++r) {
        const double s = static_cast<double>(r) / rows;
        for (int c = 0; c < around; ++c)
            mesh.points.col(r * around + c) = half_torus(s, begin + twist * s + static_cast<double>(c) / around);
    }
    Eigen::Index t = 0;
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < around; ++c) {
            const int a = r * around + c;
            const int b = r * around + (c + 1) % around;
            const bool swap = random() % 2 == 0;
            mesh.triangles.col(t++) << a, swap ? a + around : b + around, b;
            mesh.triangles.col(t++) << (swap ? b : a), a + around, b + around;
        }
    }
    return mesh;
}

// A tube's boundary with exact normals.
Problem problem_of(const test::Single& single) {
    const Patch& patch = single.patch();
    const Points boundary = single.points.rightCols(patch.vertex_count() - patch.free_count);
    Points normals = boundary;
    for (auto normal : normals.colwise())
        normal = (normal - Vector3(normal.x(), normal.y(), 0.0).normalized()).normalized();
    return {patch, boundary, normals, uniform_weights(patch), {}};
}

}  // namespace

TEST_CASE("a mesh is laid on a bent tube one to one and untwisted, however long the tube and however its rows turn") {
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
        for (const double twist : {-0.4, 0.0, 0.4}) {
            const test::Single single = test::single_patch(half_ring(seed, 0.2 * seed, twist));
            const Problem problem = problem_of(single);
            const auto tube = tube_between(problem);
            REQUIRE(tube.has_value());
            CHECK(tube->turn() == doctest::Approx(std::numbers::pi).epsilon(0.01));
            const auto start = swept_start(problem, *tube, Progress());
            REQUIRE(start.has_value());
            // The tube of the cubic is 0.02 off the torus; random diagonals move vertices by a tenth of a turn.
            CHECK((*start - single.points).colwise().norm().maxCoeff() < 0.6 * thin);
            FaceGeometry laid;
            FaceGeometry exact;
            laid.update(*start, single.patch().triangles);
            exact.update(single.points, single.patch().triangles);
            CHECK((laid.normals.array() * exact.normals.array()).colwise().sum().minCoeff() > 0.0);
        }
    }
}

TEST_CASE("nothing is laid between boundaries that don't face along one tube") {
    const test::Single single = test::single_patch(half_ring(1, 0.0));
    Problem problem = problem_of(single);
    problem.fixed_normals.leftCols(around) *= -1.0;
    CHECK_FALSE(tube_between(problem).has_value());
}
