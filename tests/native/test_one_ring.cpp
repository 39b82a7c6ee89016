#include <doctest/doctest.h>

#include "geometry/mean_curvature.h"
#include "geometry/one_ring.h"
#include "geometry/shape_operator.h"
#include "geometry/slope_fit.h"
#include "geometry/surface_fit.h"
#include "geometry/vertex_normal.h"
#include "meshes.h"

using namespace fairing;

namespace {

// Six uneven directions around a point of z = f(x, y), f and its gradient zero at the origin.
std::vector<Vector3> ring(double size, const std::function<double(double, double)>& height) {
    std::vector<Vector3> points;
    const double angles[] = {0.1, 1.0, 2.2, 3.3, 4.1, 5.4};
    const double lengths[] = {1.0, 0.8, 1.3, 0.9, 1.1, 0.7};
    for (int k = 0; k < 6; ++k) {
        const double x = size * lengths[k] * std::cos(angles[k]);
        const double y = size * lengths[k] * std::sin(angles[k]);
        points.emplace_back(x, y, height(x, y));
    }
    return points;
}

}  // namespace

TEST_CASE("normals along the two sides of a corner determine the curvature") {
    // Sides along 20° and 75° of the paraboloid, no point between them; −n turns by II along each side.
    const double a = 0.7;
    const double b = -0.3;
    const double c = -0.2;
    CurvatureLeastSquares fit(Vector3::UnitZ());
    for (const double angle : {0.35, 1.31}) {
        const double x = 1e-3 * std::cos(angle);
        const double y = 1e-3 * std::sin(angle);
        const Vector3 point(x, y, 0.5 * (a * x * x + 2.0 * b * x * y + c * y * y));
        fit.add_point(point);
        fit.add_twist(point, Vector3(-a * x - b * y, -b * x - c * y, 1.0).normalized(), 1.0);
    }
    CHECK(CurvatureFit::of(fit.solve()).mean() == doctest::Approx(0.5 * (a + c)).epsilon(1e-5));
    CHECK(CurvatureFit::of(fit.solve()).gaussian() == doctest::Approx(a * c - b * b).epsilon(1e-5));
}

TEST_CASE("the fitted normal fades back to its start continuously") {
    // A ring that tilts more and more against the start normal passes through the whole fade without a jump.
    Vector3 last = Vector3::Zero();
    double largest_jump = 0.0;
    constexpr int steps = 4000;
    for (int k = 0; k <= steps; ++k) {
        const double tilt = 4.0 * k / steps;
        auto points = ring(1.0, [](double, double) { return 0.0; });
        for (Vector3& p : points) p.z() = tilt * p.x();
        const Vector3 normal = fitted_normal(Vector3::Zero(), points, Vector3::UnitZ());
        if (k > 0) largest_jump = std::max(largest_jump, (normal - last).norm());
        last = normal;
    }
    CHECK(largest_jump < 0.01);
    CHECK((last - Vector3::UnitZ()).norm() < 1e-12);  // far beyond the fade: the start itself
}

TEST_CASE("two vertices at once have what each has alone") {
    // Rings of 4 to 8 neighbours side by side. Sums of doubles are taken in another order.
    const auto is_same = [](const Vector3& a, const Vector3& b) { return (a - b).norm() <= 1e-13 * b.norm(); };
    for (const double jitter : {0.2, 0.45}) {
        const test::Single single = test::single_patch(test::grid(27, jitter, test::sphere));
        const Patch& patch = single.patch();
        const Points& points = single.points;
        const Points prescribed = points.rightCols(patch.vertex_count() - patch.free_count);
        FaceGeometry faces;
        faces.update(points, patch.triangles);
        const Points normals = vertex_normals(patch, points, faces, prescribed, NormalKind::fitted);
        const Points starts = max_normals(patch, points, prescribed);
        const Points virtual_points = edge_virtual_points(patch, points, faces, normals);
        const PatchCurvature curvature = patch_curvature(patch, points, faces, normals, NormalKind::fitted);
        std::size_t valences = 0;
        OneRingBuffer buffer;
        for (int v = 0; v < patch.free_count; ++v) {
            const OneRing ring = buffer.gather(patch, points, v);
            if (v > 0 && ring.size() != patch.ring(v - 1).valence()) ++valences;
            CHECK(is_same(starts.col(v), max_normal(ring)));
            if (ring.size() >= 5)
                CHECK(is_same(normals.col(v), fitted_normal(ring.centre, ring.points, max_normal(ring))));
            CurvatureLeastSquares rows(normals.col(v));
            const Vector3 centre = points.col(v);
            for (const Vector3& p : ring.points) rows.add_point(p - centre);
            for (const int edge : patch.ring(v).rim) rows.add_point(virtual_points.col(edge) - centre);
            CHECK((curvature.form.col(v) - rows.solve()).norm() < 1e-10);
        }
        CHECK(valences > 100);
        for (int e = 0; e < patch.edge_count(); ++e)
            CHECK(is_same(virtual_points.col(e), edge_virtual_point(patch, points, faces, normals, e)));
    }
}

TEST_CASE("a slope fit that leads far from its start is none") {
    std::vector<Vector3> steep;
    for (int k = 0; k < 20; ++k) {
        if (k != 2) steep.emplace_back(0.25 * (k / 5), 0.2 * (k % 5 - 2), 1.25 * (k / 5));
    }
    const Vector3 normal = Vector3(-5.0, 0.0, 1.0).normalized();
    CHECK_FALSE(fit_slopes(Vector3::Zero(), steep, Vector3::UnitZ(), Degree::quadratic).has_value());
    CHECK(fit_slopes(Vector3::Zero(), steep, normal, Degree::quadratic).has_value());
}
