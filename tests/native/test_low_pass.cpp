#include <doctest/doctest.h>

#include <numeric>
#include <random>

#include "detail/low_pass.h"
#include "meshes.h"

using namespace fairing;

namespace {

constexpr int side = 48;  // edges of the grid

using Surface = Vector3 (*)(double u, double v);

// A grid with noise of this many edges upwards, and the vertices of its first side.
struct Edge {
    test::Mesh mesh;
    Points normals;  // of the surface, at those vertices
    Points exact;
    Indices vertices = Indices(side + 1);

    Edge(Surface surface, double noise, unsigned seed = 1)
        : mesh(test::grid(side, 0.3, surface)), normals(3, side + 1), exact(3, side + 1) {
        std::iota(vertices.begin(), vertices.end(), 0);
        exact = mesh.points.leftCols(side + 1);
        std::mt19937 random(seed);
        std::normal_distribution<double> height(0.0, noise / side);
        for (int k = 0; k <= side; ++k) normals.col(k) = normal_of(surface, static_cast<double>(k) / side, 0.0);
        for (auto point : mesh.points.colwise()) point.z() += height(random);
    }

    static Vector3 normal_of(Surface surface, double u, double v) {
        constexpr double h = 1e-5;
        return (surface(u + h, v) - surface(u - h, v)).cross(surface(u, v + h) - surface(u, v - h)).normalized();
    }

    // Root mean squares over the inner half: degrees, and edges off the surface.
    struct Errors {
        double normal;
        double place;
    };
    [[nodiscard]] Errors errors(double wavelength) const {
        const LowPass smooth = low_pass(mesh.points, mesh.triangles, vertices, wavelength);
        Errors sum{0.0, 0.0};
        for (int k = side / 4; k <= 3 * side / 4; ++k) {
            REQUIRE(smooth.found[k]);
            sum.normal += (smooth.normals.col(k) - normals.col(k)).squaredNorm();
            sum.place += std::pow(normals.col(k).dot(smooth.points.col(k) - exact.col(k)) * side, 2);
        }
        const double count = 1.0 + side / 2.0;
        return {std::sqrt(sum.normal / count) * 180.0 / 3.14159265358979, std::sqrt(sum.place / count)};
    }
};

Vector3 saddle(double u, double v) { return {u, v, 0.5 * (u - 0.5) * (u - 0.5) - 0.3 * v * v}; }

}  // namespace

TEST_CASE("noise of a quarter edge is taken away: what is left falls with the wavelength") {
    const Edge edge(test::sphere, 0.25, 3);
    const Edge::Errors narrow = edge.errors(0.1);
    const Edge::Errors wide = edge.errors(0.3);
    CHECK(wide.normal < 1.0);
    CHECK(wide.place < 0.06);
    CHECK(narrow.normal > 2.0 * wide.normal);
}

TEST_CASE("a saddle is followed through noise, though no sphere fits it") {
    const Edge::Errors errors = Edge(saddle, 0.25, 5).errors(0.25);
    CHECK(errors.normal < 2.0);
    CHECK(errors.place < 0.12);
}

TEST_CASE("where there is no surface nothing is found, and the vertex stays") {
    Points points(3, 4);
    points << 0.0, 1.0, 0.0, 5.0, 0.0, 0.0, 1.0, 5.0, 0.0, 0.0, 0.0, 5.0;
    Triangles triangles(3, 1);
    triangles << 0, 1, 2;
    const LowPass smooth = low_pass(points, triangles, {0, 3}, 1.0);
    CHECK(smooth.found == std::vector<char>{0, 0});
    CHECK(smooth.points.col(1) == points.col(3));
    CHECK(smooth.normals.isZero(0.0));
}
