#include <doctest/doctest.h>

#include "meshes.h"
#include "problem/willmore.h"

using namespace fairing;

namespace {

struct Surface {
    test::Single single;
    Points conormal;

    explicit Surface(const test::Mesh& mesh, const std::function<Vector3(const Vector3&)>& normal)
        : single(test::single_patch(mesh)) {
        const int fixed = patch().vertex_count() - patch().free_count;
        Points normals(3, fixed);
        for (int k = 0; k < fixed; ++k) normals.col(k) = normal(single.points.col(patch().free_count + k));
        conormal = conormals(patch(), single.points.rightCols(fixed), normals);
    }

    [[nodiscard]] const Patch& patch() const { return single.patch(); }

    [[nodiscard]] double energy(const Points& points) const {
        FaceGeometry faces;
        faces.update(points, patch().triangles);
        Stiffness stiffness;
        stiffness.update(faces, patch());
        return willmore_energy(mixed_curvature_vectors(patch(), stiffness, points, conormal), stiffness);
    }

    [[nodiscard]] Points gradient(const Points& points) const {
        FaceGeometry faces;
        faces.update(points, patch().triangles);
        Stiffness stiffness;
        stiffness.update(faces, patch());
        return willmore_gradient(patch(), stiffness, points,
                                 mixed_curvature_vectors(patch(), stiffness, points, conormal));
    }
};

}  // namespace

TEST_CASE("the gradient is that of central differences") {
    const test::Mesh mesh =
        test::grid(5, 0.3, [](double u, double v) { return Vector3(u, v, 0.3 * u * u - 0.2 * u * v); });
    const Surface surface(mesh, [](const Vector3&) { return Vector3(0.2, -0.1, 1.0).normalized(); });
    const Points gradient = surface.gradient(surface.single.points);
    constexpr double step = 1e-5;
    for (int v = 0; v < surface.patch().free_count; ++v) {
        for (int k = 0; k < 3; ++k) {
            Points plus = surface.single.points;
            Points minus = plus;
            plus(k, v) += step;
            minus(k, v) -= step;
            const double numeric = (surface.energy(plus) - surface.energy(minus)) / (2.0 * step);
            CHECK(gradient(k, v) == doctest::Approx(numeric).epsilon(1e-5).scale(gradient.cwiseAbs().maxCoeff()));
        }
    }
}
