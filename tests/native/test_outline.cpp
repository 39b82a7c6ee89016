#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "boundary/bad_boundary.h"
#include "boundary/fitted_boundary.h"
#include "boundary/low_passed_boundary.h"
#include "boundary/normal_filter.h"
#include "meshes.h"
#include "shape/visible_join.h"

using namespace fairing;

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

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

// Quads of unit size, cut in two, with corners at (i, j) on z = height(i, j).
template <typename Height>
Points grid_points(int columns, int rows, const Height& height) {
    Points points(3, columns * rows);
    for (int k = 0; k < points.cols(); ++k) {
        const int i = k % columns;
        const int j = k / columns;
        points.col(k) = Vector3(i, j, height(i, j));
    }
    return points;
}

// Of the quads whose column lies in [first, last).
Triangles grid_triangles(int columns, int rows, int first, int last) {
    Triangles triangles(3, 2 * (last - first) * (rows - 1));
    int t = 0;
    for (int j = 0; j + 1 < rows; ++j) {
        for (int i = first; i < last; ++i) {
            const int a = j * columns + i;
            triangles.col(t++) << a, a + 1, a + columns + 1;
            triangles.col(t++) << a, a + columns + 1, a + columns;
        }
    }
    return triangles;
}

constexpr int columns = 9;
constexpr int rows = 9;
constexpr int seam = 4;

Indices seam_vertices() {
    Indices outline;
    for (int j = 0; j < rows; ++j) outline.push_back(j * columns + seam);
    return outline;
}

// Heights of this standard deviation.
Points rough_plane(unsigned seed, double noise) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, noise);
    return grid_points(columns, rows, [&](int, int) { return normal(random); });
}

template <typename Height>
VectorX joined(const Height& height, const std::optional<Points>& before = std::nullopt) {
    const JoinedMesh mesh{grid_points(columns, rows, height), grid_triangles(columns, rows, 0, seam),
                          grid_triangles(columns, rows, seam, columns - 1), before};
    return visible_join(mesh, seam_vertices()).degrees;
}

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

TEST_CASE("a kink between planes is as visible as its angle") {
    const double slope = 0.2;
    const auto ridge = [&](int i, int) { return i > seam ? -slope * (i - seam) : 0.0; };
    const VectorX join = joined(ridge);
    for (double value : join) CHECK(value == doctest::Approx(std::atan(slope) * degrees).epsilon(1e-9));
    CHECK(joined(ridge, grid_points(columns, rows, ridge)).maxCoeff() < 1e-9);  // it was there before
    const auto valley = [&](int i, int j) { return -ridge(i, j); };
    CHECK(joined(valley, grid_points(columns, rows, ridge)).minCoeff() ==
          doctest::Approx(std::atan(slope) * degrees).epsilon(1e-9));
}

TEST_CASE("mended: noise is moved out of the outline and two rings, by a quarter of an edge at most") {
    const Points noisy = rough_plane(3, 0.15);
    const Triangles outside = grid_triangles(columns, rows, seam, columns - 1);
    const FittedBoundary fitted = fitted_boundary(noisy, outside, seam_vertices());
    CHECK(fitted.noise == doctest::Approx(0.13).epsilon(0.3));
    const Points move = fitted.vertices - noisy;
    for (int v = 0; v < noisy.cols(); ++v) {
        const int ring = v % columns - seam;
        const bool moves = ring >= 0 && ring <= 2;
        CHECK(move.col(v).isZero(0.0) != moves);
        if (moves) CHECK(move.col(v).norm() <= (3 - ring) / 3.0 * 0.25 * 1.35);  // diagonals are edges, too
    }
    CHECK(fitted.moved.size() == 3 * rows);
    const auto spread = [&](const Points& points) {
        double sum = 0.0;
        for (int v : seam_vertices()) sum += points(2, v) * points(2, v);
        return std::sqrt(sum / rows);
    };
    CHECK(spread(fitted.vertices) < 0.7 * spread(noisy));
}

TEST_CASE("mended: what is not noisy stays") {
    const auto bowl = [](int i, int j) { return 0.01 * (i * i + j * j); };
    const Points clean = grid_points(columns, rows, bowl);
    const FittedBoundary fitted =
        fitted_boundary(clean, grid_triangles(columns, rows, seam, columns - 1), seam_vertices());
    CHECK(fitted.moved.empty());
    CHECK(fitted.vertices == clean);
}

TEST_CASE("mended: no triangle turns over, vertices that would turn one are held") {
    const Triangles outside = grid_triangles(columns, rows, seam, columns - 1);
    const auto normal_of = [](const Points& points, const Eigen::Vector3i& t) -> Vector3 {
        const Vector3 a = points.col(t[0]);
        return (points.col(t[1]) - a).cross(Vector3(points.col(t[2]) - a));
    };
    std::size_t held = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        std::mt19937 random(seed);
        std::normal_distribution<double> normal(0.0, 0.3);
        Points noisy = grid_points(columns, rows, [](int, int) { return 0.0; });
        for (double& coordinate : noisy.reshaped()) coordinate += normal(random);
        const FittedBoundary fitted = fitted_boundary(noisy, outside, seam_vertices());
        for (const auto t : outside.colwise()) CHECK(normal_of(noisy, t).dot(normal_of(fitted.vertices, t)) >= 0.0);
        for (int v : fitted.held) CHECK(fitted.vertices.col(v) == noisy.col(v));
        held += fitted.held.size();
    }
    CHECK(held > 0);
}

namespace {

// The outline of a square grid bent into a disc, its vertices evenly round a circle.
struct Ring {
    test::Single single;
    Indices loop;  // fixed vertices from the first one on

    explicit Ring(int n) : single(test::single_patch(test::grid(n, 0.0, test::flat))), loop(patch().loops().front()) {
        for (int& v : loop) v -= patch().free_count;
    }
    [[nodiscard]] const Patch& patch() const { return single.patch(); }

    // Radius r and height z by the angle, normals that lean outwards by 0.5.
    template <typename Radius, typename Height>
    [[nodiscard]] OutlineData data(const Radius& r, const Height& z) const {
        const auto count = static_cast<Eigen::Index>(loop.size());
        OutlineData result{Points::Zero(3, count), Points::Zero(3, count)};
        for (Eigen::Index k = 0; k < count; ++k) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
            const Vector3 out(std::cos(angle), std::sin(angle), 0.0);
            result.points.col(loop[k]) = r(angle) * out + z(angle) * Vector3::UnitZ();
            result.normals.col(loop[k]) = (0.5 * out + Vector3::UnitZ()).normalized();
        }
        return result;
    }
};

}  // namespace

TEST_CASE(
    "low-passed: curvature does not vary along a circle of a sphere or a cone; a zigzag varies the more the finer") {
    const auto zigzag = [](const Ring& ring) {
        const double count = static_cast<double>(ring.loop.size());
        const double edge = 2.0 * std::numbers::pi / count;
        return ring.data([](double) { return 1.0; }, [&](double a) { return 0.1 * edge * std::cos(0.5 * count * a); });
    };
    const Ring coarse(8);
    const Ring fine(16);
    const OutlineData circle = coarse.data([](double) { return 1.0; }, [](double) { return 0.0; });
    CHECK(outline_variation(coarse.patch(), circle) < 1e-20);
    // ⟨n_i + n_j, e⟩ is 0.2 edges times 2 n_z, both ways, over the fourth power of nearly an edge; n of them.
    const double ratio =
        outline_variation(fine.patch(), zigzag(fine)) / outline_variation(coarse.patch(), zigzag(coarse));
    CHECK(ratio == doctest::Approx(8.0).epsilon(0.02));
    OutlineData twins = circle;
    twins.points.col(1) = twins.points.col(0);
    twins.points(2, 1) += 1e-6;
    CHECK(outline_variation(coarse.patch(), twins) < 10.0);  // 36 / 1e-6² with what is between them
    OutlineData scaled = zigzag(coarse);
    scaled.points *= 2.0;
    CHECK(outline_variation(coarse.patch(), scaled) ==
          doctest::Approx(outline_variation(coarse.patch(), zigzag(coarse)) / 4.0));
}
