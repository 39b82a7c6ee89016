// Points added to a triangle: whatever their order and roundoff, its pieces cover it once.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <set>

#include "fillet/cut_triangle.h"

using fairing::CutTriangle;
using fairing::Vector2;

namespace {

double area_of(const CutTriangle& cut, const std::array<int, 3>& corners) {
    const Vector2 first = cut.place(corners[0]);
    return 0.5 * fairing::cross2(cut.place(corners[1]) - first, cut.place(corners[2]) - first);
}

// Each side once in each direction, inside, no piece turned over, and the areas of all are that of the whole.
void check_cover(const CutTriangle& cut, double whole) {
    std::set<std::array<int, 2>> sides;
    double sum = 0.0;
    for (const auto& corners : cut.triangles()) {
        for (std::size_t k = 0; k < 3; ++k) CHECK(sides.insert({corners[k], corners[(k + 1) % 3]}).second);
        const double area = area_of(cut, corners);
        CHECK(area > -1e-12 * whole);
        sum += area;
    }
    CHECK(sum == doctest::Approx(whole).epsilon(1e-11));
}

}  // namespace

TEST_CASE("points on random ways across a triangle") {
    std::mt19937 random(20261128);
    std::uniform_real_distribution<double> share(0.05, 0.95);
    std::uniform_int_distribution<int> many(2, 9);
    std::uniform_real_distribution<double> beside(-2.0, 2.0);
    for (int trial = 0; trial < 400; ++trial) {
        const Vector2 a(0.0, 0.0);
        const Vector2 b(share(random), 0.0);
        const Vector2 c(share(random), share(random));
        CutTriangle cut(a, b, c);
        const double first = share(random);
        const double second = share(random);
        const Vector2 from = a + first * (b - a);
        const Vector2 to = b + second * (c - b);
        int last = cut.add_on_side(0, from);
        const int end = cut.add_on_side(1, to);
        const int count = many(random);
        std::vector<int> line{last};
        for (int k = 1; k < count; ++k) {
            const double at = static_cast<double>(k) / count;
            const double off = 1e-15 * beside(random);  // roundoff
            line.push_back(cut.add_inside(from + at * (to - from) + Vector2(off, -off)));
        }
        line.push_back(end);
        cut.make_delaunay();
        for (std::size_t k = 1; k < line.size(); ++k) CHECK(cut.add_edge(line[k - 1], line[k]));
        check_cover(cut, 0.5 * fairing::cross2(b - a, c - a));
    }
}

// By flips in turn such edges came and went for as many rounds as there are pairs of triangles.
TEST_CASE("edges along random ways through many points") {
    std::mt19937 random(20261129);
    std::uniform_real_distribution<double> share(0.02, 0.95);
    for (int trial = 0; trial < 40; ++trial) {
        CutTriangle cut({0.0, 0.0}, {1.0, 0.0}, {share(random), 0.02 + share(random)});
        std::vector<int> points;
        while (points.size() < 60) {
            const double v = share(random);
            const double w = (1.0 - v) * share(random);
            points.push_back(cut.add_inside(v * cut.place(1) + w * cut.place(2)));
        }
        cut.make_delaunay();
        std::sort(points.begin(), points.end(), [&](int a, int b) { return cut.place(a)[0] < cut.place(b)[0]; });
        const double whole = 0.5 * cut.place(2)[1];
        for (std::size_t k = 1; k < points.size(); ++k) CHECK(cut.add_edge(points[k - 1], points[k]));
        for (std::size_t k = 1; k < points.size(); ++k) {
            CHECK(cut.is_held(points[k - 1], points[k]));
            CHECK((cut.at(points[k - 1], points[k]) != fairing::none ||
                   cut.at(points[k], points[k - 1]) != fairing::none));
        }
        check_cover(cut, whole);
    }
}
