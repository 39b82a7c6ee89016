#include <doctest/doctest.h>

#include <random>
#include <set>

#include <Eigen/LU>

#include "geometry/self_intersection.h"
#include "meshes.h"

using namespace fairing;

namespace {

// Two meshes as one, the second moved.
test::Mesh join(const test::Mesh& first, const test::Mesh& second, const Vector3& shift) {
    test::Mesh both;
    both.points.resize(3, first.points.cols() + second.points.cols());
    both.points << first.points, second.points.colwise() + shift;
    both.triangles.resize(3, first.triangles.cols() + second.triangles.cols());
    both.triangles << first.triangles, second.triangles.array() + static_cast<int>(first.points.cols());
    return both;
}

// Whether p + s (q − p) = a + u (b − a) + v (c − a) for 0 < s < 1, 0 < u, v, u + v < 1.
bool passes(const Vector3& p, const Vector3& q, const Eigen::Matrix3d& triangle) {
    Eigen::Matrix3d edges;
    edges << q - p, triangle.col(0) - triangle.col(1), triangle.col(0) - triangle.col(2);
    const Vector3 at = edges.fullPivLu().solve(triangle.col(0) - p);
    return at.minCoeff() > 0.0 && at[0] < 1.0 && at[1] + at[2] < 1.0;
}

bool pierces(const test::Mesh& mesh, int a, int b) {
    const Eigen::Matrix3d other = mesh.points(Eigen::all, mesh.triangles.col(b));
    const auto is_corner = [&](int v) { return (mesh.triangles.col(b).array() == v).any(); };
    for (int k = 0; k < 3; ++k) {
        const int from = mesh.triangles(k, a);
        const int to = mesh.triangles((k + 1) % 3, a);
        if (is_corner(from) || is_corner(to)) continue;
        if (passes(mesh.points.col(from), mesh.points.col(to), other)) return true;
    }
    return false;
}

// All pairs, one after the other.
Indices crossings_by_force(const test::Mesh& mesh) {
    std::set<int> found;
    for (int a = 0; a < mesh.triangles.cols(); ++a) {
        for (int b = 0; b < a; ++b) {
            int shared = 0;
            for (const int v : mesh.triangles.col(a)) shared += (mesh.triangles.col(b).array() == v).any() ? 1 : 0;
            if (shared < 2 && (pierces(mesh, a, b) || pierces(mesh, b, a))) found.insert({a, b});
        }
    }
    return {found.begin(), found.end()};
}

test::Mesh triangle_soup(std::mt19937& random) {
    std::normal_distribution<double> normal(0.0, 1.0);
    std::uniform_int_distribution<int> vertex(0, 24);
    test::Mesh soup{Points(3, 25), Triangles(3, 30)};
    for (double& x : soup.points.reshaped()) x = normal(random);
    for (auto corners : soup.triangles.colwise()) {
        std::set<int> three;
        while (three.size() < 3) three.insert(vertex(random));
        std::copy(three.begin(), three.end(), corners.begin());
    }
    return soup;
}

}  // namespace

TEST_CASE("triangles that share a vertex may cross, those that share an edge fold") {
    Points points(3, 5);
    points << 0.0, 2.0, 2.0, 1.0, 1.0,  //
        0.0, -1.0, 1.0, 0.0, 0.0,       //
        0.0, 0.0, 0.0, 1.0, -1.0;
    Triangles shares_vertex(3, 2);
    shares_vertex << 0, 0, 1, 3, 2, 4;
    CHECK(crossing_triangles(shares_vertex, points) == Indices{0, 1});
    Triangles shares_edge(3, 2);
    shares_edge << 0, 1, 1, 0, 2, 3;
    CHECK(crossing_triangles(shares_edge, points).empty());
}

TEST_CASE("random triangles and rough surfaces cross as a search through all pairs finds them") {
    for (unsigned seed = 0; seed < 30; ++seed) {
        std::mt19937 random(seed);
        std::normal_distribution<double> normal(0.0, 1.0);
        const test::Mesh soup = triangle_soup(random);
        const test::Mesh far = join(soup, {1e12 * soup.points, soup.triangles}, {1e14, 0.0, 0.0});
        const test::Mesh all = join(far, {1e-9 * soup.points, soup.triangles}, {0.0, 100.0, 0.0});
        CHECK(crossing_triangles(all.triangles, all.points) == crossings_by_force(all));
        test::Mesh rough = test::grid(11, 1.0, test::sphere);
        for (double& x : rough.points.reshaped()) x += 0.02 * (seed % 5) * normal(random);
        CHECK(crossing_triangles(rough.triangles, rough.points) == crossings_by_force(rough));
    }
}
