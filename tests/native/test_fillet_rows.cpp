#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "api/fillet.h"
#include "api/fillet_rows.h"
#include "meshes.h"

using namespace fairing;

namespace {

constexpr int parts = 16;  // of the pipe's surface along each side
constexpr int rows = 6;    // of quads across it

Vector3 on_pipe(double turn, double along) {
    const double angle = 0.5 * std::numbers::pi * turn;
    return {std::cos(angle), along, std::sin(angle)};
}

FilletSurface quarter_pipe() {
    const test::Mesh mesh = test::grid(parts, 0.2, on_pipe);
    Indices fixed;
    Points normals(3, 4 * parts);
    for (int v = 0; v < mesh.points.cols(); ++v) {
        const int i = v % (parts + 1);
        const int j = v / (parts + 1);
        if (i % parts != 0 && j % parts != 0) continue;
        normals.col(static_cast<Eigen::Index>(fixed.size())) =
            Vector3(mesh.points(0, v), 0.0, mesh.points(2, v)).normalized();
        fixed.push_back(v);
    }
    Triangles triangles = mesh.triangles;
    const Vector3 a = mesh.points.col(triangles(0, 0));
    const Vector3 b = mesh.points.col(triangles(1, 0));
    const Vector3 c = mesh.points.col(triangles(2, 0));
    if ((b - a).cross(c - a).dot(a) < 0.0) triangles.row(1).swap(triangles.row(2));
    return {mesh.points, triangles, fixed, normals};
}

}  // namespace

TEST_CASE("fillets in rows: a plane section of a pipe is parted into ways of one length") {
    const FilletSurface pipe = quarter_pipe();
    const Vector3 axis = Vector3::UnitY();
    const PlacesOnFillet found =
        pipe.sections({{on_pipe(0, 0.3), on_pipe(1, 0.3), axis}, {on_pipe(1, 0.7), on_pipe(0, 0.7), axis}}, rows);
    CHECK(found.found == std::vector<char>{1, 1});
    for (int k = 1; k < rows; ++k) {
        const double share = static_cast<double>(k) / rows;
        CHECK((found.places.col(k - 1) - on_pipe(share, 0.3)).norm() < 2e-3);
        CHECK((found.places.col(rows + k - 2) - on_pipe(1.0 - share, 0.7)).norm() < 2e-3);
    }
}

TEST_CASE("fillets in rows: a section that ends elsewhere is none") {
    const FilletSurface pipe = quarter_pipe();
    CHECK(pipe.sections({{on_pipe(0, 0.3), on_pipe(1, 0.7), Vector3::UnitY()}}, rows).found == std::vector<char>{0});
}

TEST_CASE("fillets in rows: new vertices go to the middle of the quads around them, on the surface") {
    const FilletSurface pipe = quarter_pipe();
    QuadPattern pattern;
    pattern.boundary_count = 8;
    pattern.vertex_count = 9;
    pattern.quads = {{0, 1, 8, 7}, {1, 2, 3, 8}, {8, 3, 4, 5}, {7, 8, 5, 6}};
    Points points(3, 9);
    const std::array<std::array<double, 2>, 9> places{
        {{.2, .2}, {.5, .2}, {.8, .2}, {.8, .5}, {.8, .8}, {.5, .8}, {.2, .8}, {.2, .5}, {.3, .6}}};
    for (std::size_t v = 0; v < places.size(); ++v)
        points.col(static_cast<Eigen::Index>(v)) = on_pipe(places[v][0], places[v][1]);
    const PlacesOnFillet found = pipe.relaxed(pattern, points, 60);
    CHECK((found.places.col(8) - on_pipe(0.5, 0.5)).norm() < 2e-2);
    CHECK(std::abs(std::hypot(found.places(0, 8), found.places(2, 8)) - 1.0) < 1e-3);
}

TEST_CASE("fillets in rows: each point of the line knows its foot on the seam") {
    FilletInput input;
    input.vertices.resize(3, 4);
    input.vertices.transpose() << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
    input.triangles.resize(3, 2);
    input.triangles.transpose() << 0, 1, 2, 0, 2, 3;
    input.seams = {{0, 2}};
    input.widths = {VectorX::Constant(4, 0.3), VectorX::Constant(4, 0.3)};
    input.spacing = 0.1;
    const FilletLine found = fillet_line(input, {});
    CHECK(found.line.points.size() > 20);
    std::set<VertexPair> sides;
    for (std::size_t k = 0; k < found.feet.size(); ++k) {
        const FilletLine::Foot& foot = found.feet[k];
        const Vector3 tail = input.vertices.col(foot.half_edge[0]);
        const Vector3 way = Vector3(input.vertices.col(foot.half_edge[1])) - tail;
        const Vector3 off = found.line.points[k].place - (tail + foot.along / way.norm() * way);
        CHECK_FALSE(foot.corner);
        CHECK(std::abs(off.norm() - 0.3) < 1e-9);
        CHECK(std::abs(off.dot(way)) < 1e-9);
        CHECK(way.cross(off).z() > 0.0);  // on the left of the half-edge
        sides.insert(foot.half_edge);
    }
    CHECK(sides == std::set<VertexPair>{{0, 2}, {2, 0}});
}
