#include <doctest/doctest.h>

#include <limits>
#include <numbers>
#include <numeric>

#include "detail/bands.h"
#include "detail/copied_heights.h"
#include "detail/disc.h"
#include "meshes.h"

using namespace fairing;

namespace {

Points upright(Eigen::Index count) { return Vector3::UnitZ().replicate(1, count); }

VectorX wave_along_x(const Points& points, double length) {
    return (points.row(0).transpose().array() * 2.0 * std::numbers::pi / length).sin();
}

// The share of a wave that a filter of this wavelength lets through, in the middle of a square.
double share_above(double wavelength, double length) {
    const test::Mesh mesh = test::grid(80, 0.0, test::flat);
    const VectorX field = wave_along_x(mesh.points, length);
    const auto bands = Bands::of(mesh.points, mesh.triangles, {wavelength}, Progress());
    REQUIRE(bands);
    const Eigen::MatrixXd parts = bands->split(field);
    double product = 0.0;
    double square = 0.0;
    for (Eigen::Index v = 0; v < field.size(); ++v) {
        if ((mesh.points.col(v).head<2>().array() - 0.5).abs().maxCoeff() > 0.25) continue;
        product += parts(v, 1) * field[v];
        square += field[v] * field[v];
    }
    return product / square;
}

// A flat sample with a wave along x.
SkinSample striped(double length) {
    const test::Mesh mesh = test::grid(40, 0.2, test::flat);
    const Points& p = mesh.points;
    const VectorX depth = p.topRows(2).cwiseMin((1.0 - p.topRows(2).array()).matrix()).colwise().minCoeff().transpose();
    return {p, upright(p.cols()), wave_along_x(p, length), depth, mesh.triangles, 1.0 / 40.0};
}

}  // namespace

TEST_CASE("bands add up to the field, and a constant has no waves") {
    const test::Mesh mesh = test::grid(20, 0.3, test::sphere);
    const auto bands = Bands::of(mesh.points, mesh.triangles, {0.1, 0.2, 0.4}, Progress());
    REQUIRE(bands);
    const VectorX field = mesh.points.row(0).transpose().array().cube();
    CHECK((bands->split(field).rowwise().sum() - field).cwiseAbs().maxCoeff() < 1e-13);
    const Eigen::MatrixXd still = bands->split(VectorX::Constant(field.size(), 3.0));
    CHECK(still.leftCols(3).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a filter keeps half of the waves of its length") {
    CHECK(share_above(0.2, 0.2) == doctest::Approx(0.5).epsilon(0.03));
    CHECK(share_above(0.2, 0.05) < 0.03);
    CHECK(share_above(0.2, 0.8) > 0.92);
}

TEST_CASE("a disc has its nearest vertices and its linear fields") {
    const test::Mesh mesh = test::grid(30, 0.2, test::flat);
    const Points normals = upright(mesh.points.cols());
    const VectorX field = 2.0 * mesh.points.row(0).transpose() - 0.7 * mesh.points.row(1).transpose();
    Discs discs(mesh.points, normals, mesh.triangles);
    for (const int centre : {480, 200, 700}) {
        discs.cut(centre, 0.2);
        const Vector3 middle = mesh.points.col(centre);
        for (int k = 0; k < 40; ++k) {
            const Vector3 offset(0.12 * std::sin(3.0 * k), 0.12 * std::sin(5.0 * k + 1.0), 0.0);
            const Vector3 place = middle + offset;
            Eigen::Index nearest = 0;
            (mesh.points.colwise() - place).colwise().squaredNorm().minCoeff(&nearest);
            CHECK(discs.nearest(offset) == nearest);
            if (place.head<2>().minCoeff() < 0.0 || place.head<2>().maxCoeff() > 1.0) continue;
            CHECK(discs.value(field, offset) == doctest::Approx(2.0 * place.x() - 0.7 * place.y()).epsilon(0.02));
        }
    }
}

TEST_CASE("offsets lie in the tangent plane and are as long as the straight distances") {
    const test::Mesh mesh = test::grid(10, 0.2, test::sphere);
    Indices all(static_cast<std::size_t>(mesh.points.cols()));
    std::iota(all.begin(), all.end(), 0);
    const Vector3 normal = mesh.points.col(0);
    const Points offsets = tangent_offsets(mesh.points, normal, all);
    CHECK((normal.transpose() * offsets).cwiseAbs().maxCoeff() < 1e-14);
    const auto lengths = (mesh.points.colwise() - normal).colwise().norm();
    CHECK((offsets.colwise().norm() - lengths).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("copied stripes keep their height and their direction, and go on from what is known") {
    const double length = 0.1;
    const SkinSample sample = striped(length);
    const test::Mesh mesh = test::grid(50, 0.2, test::flat);
    const Points normals = upright(mesh.points.cols());
    const VectorX wanted = wave_along_x(mesh.points, length);
    VectorX known = VectorX::Constant(wanted.size(), std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index v = 0; v < known.size(); ++v) {
        if (mesh.points(1, v) < 0.05) known[v] = wanted[v];
    }
    const VectorX heights = copied_heights({mesh.points, normals, mesh.triangles, known}, sample, 0.2);
    CHECK(heights.norm() / wanted.norm() == doctest::Approx(1.0).epsilon(0.15));
    // Along the stripes little changes.
    double along = 0.0;
    double across = 0.0;
    for (const auto t : mesh.triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const Vector3 edge = mesh.points.col(t[(k + 1) % 3]) - mesh.points.col(t[k]);
            const double slope = std::pow((heights[t[(k + 1) % 3]] - heights[t[k]]) / edge.norm(), 2);
            if (std::abs(edge.x()) < 0.2 * edge.norm()) along += slope;
            if (std::abs(edge.y()) < 0.2 * edge.norm()) across += slope;
        }
    }
    CHECK(along < 0.2 * across);
    double product = 0.0;
    for (Eigen::Index v = 0; v < known.size(); ++v) {
        if (mesh.points(1, v) < 0.2) product += heights[v] * wanted[v];
    }
    CHECK(product > 0.0);
}
