// Fronts of quads: rings and rows keep count, and poles close a walk on the lattice.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "quads/candidates.h"
#include "quads/closings.h"

using namespace fairing;

namespace {

Eigen::Matrix2Xd circle(int count) {
    Eigen::Matrix2Xd places(2, count);
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        places.col(k) = Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    return places;
}

// Faces around each vertex, of a disc whose border is the pattern's boundary in its direction; empty: it is none.
Indices faces_around(const QuadPattern& pattern) {
    Indices around(static_cast<std::size_t>(pattern.vertex_count));
    std::set<std::pair<int, int>> sides;
    bool once = true;
    const auto add = [&](const auto& face) {
        for (std::size_t k = 0; k < face.size(); ++k) {
            once = sides.emplace(face[k], face[(k + 1) % face.size()]).second &&
                   face[k] != face[(k + 1) % face.size()] && once;
            ++around[face[k]];
        }
    };
    for (const auto& quad : pattern.quads) add(quad);
    for (const auto& triangle : pattern.triangles) add(triangle);
    int open = 0;
    for (const auto& [a, b] : sides) {
        if (sides.contains({b, a})) continue;
        ++open;
        once = once && a < pattern.boundary_count && b == (a + 1) % pattern.boundary_count;
    }
    const int edges = (static_cast<int>(sides.size()) + open) / 2;
    const int faces = static_cast<int>(pattern.quads.size() + pattern.triangles.size());
    const bool disc = open == pattern.boundary_count && pattern.vertex_count - edges + faces == 1;
    return once && disc && !std::ranges::count(around, 0) ? around : Indices();
}

// How many quads each vertex of a boundary gets: up to six convex corners, four edges apart or more.
Indices drawn_corners(int count, std::mt19937& random) {
    Indices faces(static_cast<std::size_t>(count), 2);
    int corners = 0;
    for (auto tries = random() % 20; tries > 0 && corners < 6; --tries) {
        const int at = static_cast<int>(random() % static_cast<unsigned>(count));
        bool free = true;
        for (int k = -3; k <= 3; ++k) free = free && faces[(at + k + count) % count] == 2;
        if (!free) continue;
        faces[at] = 1;
        ++corners;
    }
    return faces;
}

HoleBoundary boundary_of(Eigen::Matrix2Xd places, double cells) {
    HoleBoundary boundary;
    boundary.places = std::move(places);
    boundary.cells = cells;
    return boundary;
}

}  // namespace

TEST_CASE("patterns of every boundary are discs of quads, with one triangle for odd counts, and have its corners") {
    std::mt19937 random(3);
    std::map<int, int> extra;  // poles above the least number
    int total = 0;
    int without = 0;
    for (int run = 0; run < 318; ++run) {
        const int count = 8 + run % 53;
        const Indices faces = drawn_corners(count, random);
        const double cells = count * count / (4.0 * std::numbers::pi);
        const auto found = patterns_with_corners(boundary_of(circle(count), cells), faces, 4);
        without += found.empty() ? 1 : 0;
        int quarters = 0;
        for (int each : faces) quarters += 2 - each;
        for (const CandidatePattern& each : found) {
            CHECK(static_cast<int>(each.pattern.triangles.size()) == count % 2);
            CHECK(each.least_poles == std::abs(4 - quarters));
            const Indices around = faces_around(each.pattern);
            REQUIRE_FALSE(around.empty());
            CHECK(Indices(around.begin(), around.begin() + count) == faces);
            const auto inner =
                static_cast<int>(std::count_if(around.begin() + count, around.end(), [](int n) { return n != 4; }));
            CHECK(inner <= each.poles + 3 * (count % 2));
            ++extra[each.poles - each.least_poles];
            ++total;
        }
    }
    CHECK(extra[0] + extra[2] + extra[4] == total);
    CHECK(extra[4] < 0.05 * total);
    CHECK(without < 8);
}

TEST_CASE("rings that would meet themselves are refused") {
    Eigen::Matrix2Xd places(2, 8);
    places << 0, 1, 2, 2, 2, 1, 0, 0, 0, 0, 0, 1, 2, 2, 2, 1;
    QuadFront front({1, 2, 1, 2, 1, 2, 1, 2}, places, {});
    CHECK_FALSE(front.add_ring());
    CHECK(front.quad_count() == 0);
    CHECK(front.filled()->quads.size() == 4);
}
