#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

#include "fill/ball_start.h"
#include "fill/edge_lengths.h"
#include "fill/even_mesh.h"
#include "fill/first_surface.h"
#include "fill/harmonic_values.h"
#include "fill/joined_loops.h"
#include "fill/triangulation.h"
#include "fill/tube_start.h"
#include "meshes.h"

using namespace fairing;

namespace {

Indices first_numbers(int n, int begin = 0) {
    Indices numbers(n);
    std::iota(numbers.begin(), numbers.end(), begin);
    return numbers;
}

double total(const std::vector<Eigen::Vector3i>& triangles, const TriangleCost& cost) {
    double sum = 0.0;
    for (const Eigen::Vector3i& t : triangles) sum += cost(t[0], t[1], t[2]);
    return sum;
}

// Of all triangulations, one after the other.
double cheapest_by_trying(const Indices& polygon, const TriangleCost& cost) {
    if (polygon.size() < 3) return 0.0;
    double least = 1e300;
    for (std::size_t j = 1; j + 1 < polygon.size(); ++j) {
        const Indices before(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        const Indices after(polygon.begin() + static_cast<std::ptrdiff_t>(j), polygon.end());
        const double here = cost(polygon.front(), polygon[j], polygon.back()) + cheapest_by_trying(before, cost) +
                            cheapest_by_trying(after, cost);
        least = std::min(least, here);
    }
    return least;
}

Points random_polygon(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-0.4, 0.4);
    Points points(3, n);
    for (int k = 0; k < n; ++k) {
        const double turn = 2.0 * std::numbers::pi * k / n;
        points.col(k) << std::cos(turn) + noise(random), std::sin(turn) + noise(random), noise(random);
    }
    return points;
}

// Each side once, and those without a partner in the other direction.
std::vector<std::pair<int, int>> open_sides(const Triangles& triangles) {
    std::map<std::pair<int, int>, int> sides;
    for (const auto t : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
    }
    std::vector<std::pair<int, int>> open;
    for (const auto& [side, count] : sides) {
        CHECK(count == 1);
        if (!sides.contains({side.second, side.first})) open.push_back(side);
    }
    return open;
}

Points ring(int n, double height, double turn = 0.0) {
    Points points(3, n);
    for (int k = 0; k < n; ++k) {
        const double angle = turn + 2.0 * std::numbers::pi * k / n;
        points.col(k) << std::cos(angle), std::sin(angle), height;
    }
    return points;
}

}  // namespace

TEST_CASE("no triangulation of a small polygon is cheaper than the one found") {
    for (unsigned seed = 0; seed < 8; ++seed) {
        const Points points = random_polygon(9, seed);
        const TriangleCost cost(points);
        const Indices polygon = first_numbers(9);
        const auto triangles = cheapest_triangulation(polygon, cost);
        CHECK(triangles.size() == 7);
        CHECK(total(triangles, cost) == doctest::Approx(cheapest_by_trying(polygon, cost)).epsilon(1e-12));
    }
}

TEST_CASE("a flat polygon that is not convex is covered once") {
    constexpr int n = 40;
    Points points(3, n);
    double area = 0.0;
    for (int k = 0; k < n; ++k) {
        const double turn = 2.0 * std::numbers::pi * k / n;
        const double radius = k % 2 == 0 ? 1.0 : 0.5;
        points.col(k) << radius * std::cos(turn), radius * std::sin(turn), 0.0;
    }
    for (int k = 0; k < n; ++k)
        area += 0.5 * (points(0, k) * points(1, (k + 1) % n) - points(1, k) * points(0, (k + 1) % n));
    double covered = 0.0;
    for (const Eigen::Vector3i& t : cheapest_triangulation(first_numbers(n), TriangleCost(points))) {
        const Vector3 across = (points.col(t[1]) - points.col(t[0])).cross(points.col(t[2]) - points.col(t[0]));
        CHECK(across.z() > 0.0);
        covered += 0.5 * across.z();
    }
    CHECK(covered == doctest::Approx(area));
}

TEST_CASE("a long polygon is triangulated in little time and completely") {
    constexpr int n = 5000;
    const Points points = ring(n, 0.0);
    const auto triangles = cheapest_triangulation(first_numbers(n), TriangleCost(points));
    CHECK(triangles.size() == n - 2);
    double area = 0.0;
    for (const Eigen::Vector3i& t : triangles)
        area += 0.5 * (points.col(t[1]) - points.col(t[0])).cross(points.col(t[2]) - points.col(t[0])).z();
    CHECK(area == doctest::Approx(std::numbers::pi).epsilon(1e-5));
}

TEST_CASE("two rings become a tube without caps, however far apart") {
    for (const double gap : {0.2, 2.0, 8.0}) {
        Points points(3, 36);
        points << ring(20, 0.0), ring(16, gap, 0.1);
        const Indices below = first_numbers(20);
        Indices above = first_numbers(16, 20);
        std::reverse(above.begin(), above.end());
        const Triangles triangles = joined_loops(points, {below, above});
        CHECK(triangles.cols() == 36);
        CHECK(open_sides(triangles).size() == 36);
        for (const auto t : triangles.colwise()) {
            const bool rises = std::min({t[0], t[1], t[2]}) < 20 && std::max({t[0], t[1], t[2]}) >= 20;
            CHECK(rises);
            const Vector3 across = (points.col(t[1]) - points.col(t[0])).cross(points.col(t[2]) - points.col(t[0]));
            CHECK(across.dot(points.col(t[0]) - Vector3(0.0, 0.0, points(2, t[0]))) > 0.0);  // outwards
        }
    }
}

TEST_CASE("four rings become a sphere with four holes") {
    constexpr int n = 12;
    Points points(3, 4 * n);
    std::vector<Indices> loops;
    for (int l = 0; l < 4; ++l) {
        const Eigen::AngleAxisd turn(2.0 * std::numbers::pi * l / 4.0, Vector3::UnitX());
        points.middleCols(l * n, n) = turn.toRotationMatrix() * ring(n, 2.5);
        Indices loop = first_numbers(n, l * n);
        std::reverse(loop.begin(), loop.end());
        loops.push_back(loop);
    }
    const Triangles triangles = joined_loops(points, loops);
    CHECK(triangles.cols() == 4 * n + 2 * 2);  // n − 2 + 2 (holes − 1) triangles for holes of n edges in all
    CHECK(open_sides(triangles).size() == 4 * n);
}

TEST_CASE("lengths are the outline's at the outline and grow by half of the way") {
    const test::Single single = test::single_patch(test::grid(24, 0.0, test::flat));
    const Patch& patch = single.patch();
    const double edge = (single.points.col(patch.edge_ends[0][0]) - single.points.col(patch.edge_ends[0][1])).norm();
    for (const double spacing : {0.25 * edge, 4.0 * edge}) {
        const VectorX lengths = edge_lengths(patch, single.points, {spacing, 0, Spread::even});
        for (int e = 0; e < patch.edge_count(); ++e) {
            const auto [a, b] = patch.edge_ends[e];
            const double length = (single.points.col(a) - single.points.col(b)).norm();
            if (patch.edge_triangles[e][1] == none) CHECK(lengths[a] > 0.0);
            CHECK(std::abs(lengths[a] - lengths[b]) <= 0.5 * length + 1e-12);
        }
        const double middle = spacing < edge ? lengths.minCoeff() : lengths.maxCoeff();
        CHECK(middle == doctest::Approx(spacing));
    }
}

TEST_CASE("lengths shrink until they give the vertices wanted") {
    const test::Single single = test::single_patch(test::grid(12, 0.0, test::flat));
    const VectorX few = edge_lengths(single.patch(), single.points, {0.0, 0});
    const VectorX many = edge_lengths(single.patch(), single.points, {0.0, 1000});
    CHECK(expected_count(single.patch(), single.points, few) < 500.0);
    CHECK(expected_count(single.patch(), single.points, many) >= 1000.0);
    CHECK(expected_count(single.patch(), single.points, many) < 1100.0);
}

namespace {

// A flat square of n × n quads, stretched so that a fan of its triangles has wide angles; the border is fixed.
struct Stretched {
    Patch patch;
    Points points;
};

Stretched stretched_square(int n) {
    const auto is_border = [n](int v) { return v / (n + 1) % n == 0 || v % (n + 1) % n == 0; };
    Indices number((n + 1) * (n + 1));
    PatchMembers members;
    Indices order;
    for (const bool border : {false, true}) {
        for (int v = 0; v < (n + 1) * (n + 1); ++v) {
            if (is_border(v) != border) continue;
            number[v] = static_cast<int>(order.size());
            order.push_back(v);
            if (!border) ++members.free_count;
        }
    }
    members.triangles.resize(3, 2 * n * n);
    Eigen::Index t = 0;
    for (int row = 0; row < n; ++row) {
        for (int column = 0; column < n; ++column) {
            const int a = row * (n + 1) + column;
            members.triangles.col(t++) << number[a], number[a + 1], number[a + n + 2];
            members.triangles.col(t++) << number[a], number[a + n + 2], number[a + n + 1];
        }
    }
    members.to_input = first_numbers(static_cast<int>(order.size()));
    members.input_triangle = first_numbers(2 * n * n);
    members.pin.assign(order.size(), 0);
    Points points(3, static_cast<Eigen::Index>(order.size()));
    for (std::size_t k = 0; k < order.size(); ++k) {
        const double x = order[k] % (n + 1);
        const double y = order[k] / (n + 1);
        points.col(static_cast<Eigen::Index>(k)) << x + 0.8 * y, 0.3 * y, 0.0;  // sheared: angles beyond 120°
    }
    return {Patch(std::move(members)), points};
}

}  // namespace

TEST_CASE("harmonic values stay within the range of those given, wide angles or not") {
    const Stretched square = stretched_square(8);
    const int fixed_count = square.patch.vertex_count() - square.patch.free_count;
    Eigen::MatrixXd given(fixed_count, 2);
    for (int k = 0; k < fixed_count; ++k) given.row(k) << (k == 3 ? 1.0 : 0.0), (k % 7 == 0 ? -1.0 : 2.0);
    const auto inside = harmonic_values(square.patch, square.points, given);
    REQUIRE(inside);
    for (int c = 0; c < 2; ++c) {
        CHECK(inside->col(c).minCoeff() >= given.col(c).minCoeff() - 1e-12);
        CHECK(inside->col(c).maxCoeff() <= given.col(c).maxCoeff() + 1e-12);
    }
}

TEST_CASE("a mesh over a crumpled surface does not grow without end") {
    Stretched square = stretched_square(6);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise(-4.0, 4.0);
    const auto any = [&] { return Vector3(noise(random), noise(random), noise(random)); };
    for (int v = 0; v < square.patch.free_count; ++v) square.points.col(v) += any();
    const auto count = square.points.cols();
    Points normals(3, count);
    for (Eigen::Index v = 0; v < count; ++v) normals.col(v) = any().normalized();
    const TargetSurface surface(square.patch, square.points, normals);
    const VectorX lengths = VectorX::Constant(count, 0.7);
    EvenMesh mesh(square.patch, square.points, surface, lengths);
    mesh.make_even();
    const double expected = expected_count(square.patch, square.points, lengths) + static_cast<double>(count);
    CHECK(static_cast<double>(mesh.result().points.cols()) < 3.0 * expected);  // six times without a limit
}

TEST_CASE("chords at sharp corners stay but where their triangle is turned against the outline's normals") {
    Stretched square = stretched_square(6);
    square.points.row(0) -= 1.6 / 0.3 * square.points.row(1);  // sheared to the other side: chords at sharp corners
    const auto count = square.points.cols();
    const Points flat = Points::Zero(3, count);
    const TargetSurface surface(square.patch, square.points, flat);
    const VectorX lengths = VectorX::Ones(count);
    const auto splits = [&](const Points& normals) {
        EvenMesh mesh(square.patch, square.points, surface, lengths);
        return mesh.split_chords(normals);
    };
    const Points up = Vector3::UnitZ().replicate(1, count - square.patch.free_count);
    CHECK(splits(up) == 0);
    CHECK(splits({}) == 0);
    CHECK(splits(-up) == 2);
}

namespace {

// A flat disc with its rim on a unit ball around the origin, at this angle from the direction of `side` · z.
test::Single disc_on_ball(double half_angle, double side) {
    return test::single_patch(test::grid(
        12, 0.0,
        [&](double u, double v) {
            const double x = 2.0 * u - 1.0;
            const double y = 2.0 * v - 1.0;
            const double turn = std::atan2(y, x);
            const double radius = std::max(std::abs(x), std::abs(y)) * std::sin(half_angle);
            return Vector3(radius * std::cos(turn), radius * std::sin(turn), side * std::cos(half_angle));
        },
        false));
}

}  // namespace

TEST_CASE("a start that bulges out beyond its outline lies on the ball of the outline's normals") {
    constexpr double degree = std::numbers::pi / 180.0;
    for (const double side : {1.0, -1.0}) {
        for (const double angle : {120.0, 150.0, 170.0}) {
            const test::Single disc = disc_on_ball(angle * degree, side);
            const Patch& patch = disc.patch();
            const Points normals = side * disc.points.rightCols(patch.vertex_count() - patch.free_count);
            const Vector3 away(3.0, -2.0, 1.0);
            const Points places = (5.0 * disc.points).colwise() + away;
            const auto start = ball_start(patch, places, normals);
            REQUIRE(start.has_value());
            const Points local = (start->colwise() - away) / 5.0;
            CHECK((local.colwise().norm().array() - 1.0).abs().maxCoeff() < 1e-12);
            CHECK((local.rightCols(normals.cols()) - disc.points.rightCols(normals.cols())).norm() < 1e-12);
            CHECK((side * local.row(2)).maxCoeff() > 0.9);  // its far side, seen from the outline
            FaceGeometry faces;
            faces.update(local, patch.triangles);
            CHECK(faces.areas.sum() > 0.9 * 2.0 * std::numbers::pi * (1.0 - std::cos(angle * degree)));
        }
    }
}

TEST_CASE("no ball is taken where a flat start does, or where the normals name none") {
    constexpr double degree = std::numbers::pi / 180.0;
    for (const double angle : {40.0, 90.0, 110.0}) {
        const test::Single disc = disc_on_ball(angle * degree, 1.0);
        const int fixed_count = disc.patch().vertex_count() - disc.patch().free_count;
        CHECK_FALSE(ball_start(disc.patch(), disc.points, disc.points.rightCols(fixed_count)).has_value());
    }
    const test::Single wide = disc_on_ball(150.0 * degree, 1.0);
    const int fixed_count = wide.patch().vertex_count() - wide.patch().free_count;
    Points upright = Points::Zero(3, fixed_count);
    upright.row(2).setOnes();
    CHECK_FALSE(ball_start(wide.patch(), wide.points, upright).has_value());
}

TEST_CASE("the surface over a rim that asks for nearly a whole ball is found from there at once") {
    constexpr int n = 36;
    constexpr double degree = std::numbers::pi / 180.0;
    for (const double half_angle : {100.0 * degree, 150.0 * degree}) {
        const double radius = 0.5 / std::sin(half_angle);
        const Points rim = radius * (ring(n, 1.0 / std::tan(half_angle)) * std::sin(half_angle));
        const FirstSurface found = first_surface({rim, rim / radius, {first_numbers(n)}}, SolverOptions(), Progress());
        CHECK(found.solution.termination == Termination::converged);
        CHECK((found.solution.points.colwise().norm().array() / radius - 1.0).abs().maxCoeff() < 1e-3);
        const bool at_once = found.solution.ways.size() == 1 && found.solution.ways.front().name == "near";
        CHECK(at_once == (half_angle > 115.0 * degree));
    }
}

namespace {

// The rims of a part of a torus of radius 1 around the z axis.
struct Elbow {
    Points points;
    Points normals;
    std::vector<Indices> loops;
};

Elbow elbow(int n, double radius, int shift = 0, double bend = 0.5 * std::numbers::pi) {
    Elbow result{Points(3, 2 * n), Points(3, 2 * n), {}};
    for (int k = 0; k < 2 * n; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + (k < n ? 0 : shift)) / n;
        const Vector3 out = k < n ? Vector3::UnitX() : Vector3(std::cos(bend), std::sin(bend), 0.0);
        result.normals.col(k) = std::cos(angle) * out + std::sin(angle) * Vector3::UnitZ();
        result.points.col(k) = out + radius * result.normals.col(k);
    }
    Indices below = first_numbers(n);
    std::reverse(below.begin(), below.end());
    result.loops = {below, first_numbers(n, n)};
    return result;
}

}  // namespace

TEST_CASE("a start between two rims follows the bend, however thin the tube and wherever its rims begin") {
    for (const double radius : {0.4, 0.1, 0.02}) {
        for (const int shift : {0, 7}) {
            for (const double bend : {0.5, 1.0}) {
                const Elbow rims = elbow(24, radius, shift, bend * std::numbers::pi);
                const auto swept = SweptTube::between(rims.loops, rims.points, rims.normals);
                REQUIRE(swept.has_value());
                const TubeMesh tube = tube_start(*swept);
                CHECK(open_sides(tube.triangles).size() == 48);
                Points points(3, tube.points.cols() + rims.points.cols());
                points << tube.points, rims.points;
                for (const auto place : tube.points.colwise()) {
                    // A cubic is .0003 off an arc of 90° of radius 1, and .02 off one of 180°.
                    const double away = std::hypot(std::hypot(place.x(), place.y()) - 1.0, place.z());
                    CHECK(std::abs(away - radius) < 0.03 * radius + (bend > 0.9 ? 0.02 : 0.0));
                }
                FaceGeometry faces;
                faces.update(points, tube.triangles);
                const double area = 2.0 * bend * std::numbers::pi * std::numbers::pi * radius;
                CHECK(faces.areas.sum() == doctest::Approx(area).epsilon(0.02));
            }
        }
    }
}

TEST_CASE("no tube begins between rims around a flat ring, or where one of them is seen from inside") {
    const Elbow rims = elbow(24, 0.4);
    Elbow flat = rims;
    flat.points << ring(24, 0.0), 2.0 * ring(24, 0.0);
    flat.normals << 0.2 * ring(24, 0.0), 0.2 * ring(24, 0.0);  // nearly flat, seen from outside like a tube
    flat.normals.row(2).setOnes();
    flat.normals.colwise().normalize();
    CHECK_FALSE(SweptTube::between(flat.loops, flat.points, flat.normals).has_value());
    Points half = rims.normals;
    half.leftCols(24) *= -1.0;
    CHECK_FALSE(SweptTube::between(rims.loops, rims.points, half).has_value());
    CHECK_FALSE(SweptTube::between({rims.loops[0]}, rims.points, rims.normals).has_value());
}

TEST_CASE("a thin elbow is found at once") {
    const Elbow rims = elbow(32, 0.2);
    const Vector3 middle = rims.points.rowwise().mean();
    const double size = 2.0 * (rims.points.colwise() - middle).colwise().norm().maxCoeff();
    SolverOptions options;
    const OpenOutline outline{rims.points / size, rims.normals, rims.loops};
    const FirstSurface found = first_surface(outline, options, Progress());
    CHECK(found.solution.termination == Termination::converged);
    CHECK(found.solution.ways.size() == 1);
    const Points surface = size * found.solution.points;
    const Eigen::RowVectorXd across = surface.topRows<2>().colwise().norm().array() - 1.0;
    const Eigen::RowVectorXd away = (across.array().square() + surface.row(2).array().square()).sqrt();
    CHECK((away.array() / 0.2 - 1.0).abs().maxCoeff() < 0.1);
}

TEST_CASE("a search in vain leaves a mesh of few vertices") {
    const Elbow rims = elbow(16, 0.1);
    const Vector3 middle = rims.points.rowwise().mean();
    const double size = 2.0 * (rims.points.colwise() - middle).colwise().norm().maxCoeff();
    SolverOptions options;
    options.otherwise = Otherwise::stop;
    const OpenOutline outline{rims.points / size, rims.normals, rims.loops};
    const FirstSurface in_vain = first_surface(outline, options, Progress());
    CHECK(in_vain.solution.termination != Termination::converged);
    CHECK(in_vain.patch.free_count < 1000);  // 464; 3130 where the search goes on
}
