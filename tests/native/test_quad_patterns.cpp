// Fronts of quads: rings and rows keep count, and poles close a walk on the lattice.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "quads/closings.h"

using namespace fairing;

namespace {

QuadFront round_front(int count) {
    Eigen::Matrix2Xd places(2, count);
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        places.col(k) = Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    return {Indices(static_cast<std::size_t>(count), 2), places, {}};
}

}  // namespace

TEST_CASE("a ring around a smooth hole leaves one like it") {
    QuadFront front = round_front(12);
    CHECK(front.quarters() == 0);
    REQUIRE(front.add_ring());
    CHECK(front.size() == 12);
    CHECK(front.quad_count() == 12);
    CHECK(front.faces() == Indices(12, 2));
    CHECK(front.is_new(0));
    CHECK_FALSE(front.filled().has_value());  // a straight walk leads nowhere
}

TEST_CASE("four poles close a smooth hole, best where they lie evenly") {
    QuadFront front = round_front(12);
    REQUIRE(front.add_ring());
    const std::vector<Closing> found = closings(front, std::vector<PoleKind>(4, PoleKind::three), 3);
    REQUIRE_FALSE(found.empty());
    CHECK(found.front().cell_count == 9);
    CHECK(found.front().misfit < 0.1);
    REQUIRE(front.place(found.front().poles));
    CHECK(front.quarters() == 4);
    const auto pattern = front.filled();
    REQUIRE(pattern.has_value());
    CHECK(pattern->quads.size() == 21);
    CHECK(pattern->vertex_count == 12 + 12 + 4);
}

TEST_CASE("a row along a side takes its corners on") {
    Eigen::Matrix2Xd places(2, 10);  // a rectangle of 3 × 2
    places << 0, 1, 2, 3, 3, 3, 2, 1, 0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 1;
    QuadFront front({1, 2, 2, 1, 2, 1, 2, 2, 1, 2}, places, {});
    CHECK_FALSE(front.add_row(1));
    REQUIRE(front.add_row(0));
    CHECK(front.quad_count() == 3);
    CHECK(front.size() == 8);
    CHECK(front.filled()->quads.size() == 6);
}

TEST_CASE("rings that would meet themselves are refused") {
    Eigen::Matrix2Xd places(2, 8);
    places << 0, 1, 2, 2, 2, 1, 0, 0, 0, 0, 0, 1, 2, 2, 2, 1;
    QuadFront front({1, 2, 1, 2, 1, 2, 1, 2}, places, {});
    CHECK_FALSE(front.add_ring());
    CHECK(front.quad_count() == 0);
    CHECK(front.filled()->quads.size() == 4);
}

TEST_CASE("corners of the boundary move only where their angles allow it") {
    VectorX angles = VectorX::Constant(8, 180.0);
    angles[3] = 125.0;
    Eigen::Matrix2Xd places = Eigen::Matrix2Xd::Random(2, 8);
    const QuadFront front(Indices(8, 2), places, angles);
    CHECK_FALSE(front.cost_of_turning(0, 1).has_value());
    REQUIRE(front.cost_of_turning(3, 1).has_value());
    CHECK(*front.cost_of_turning(3, 1) < 0.5);
}
