// Pieces of what holds inside a patch: faired borders, released pins, surroundings broken along creases.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "boundary/fair_border.h"
#include "boundary/low_passed_boundary.h"
#include "meshes.h"
#include "pins/spread_pins.h"
#include "problem/free_slopes.h"

using namespace fairing;

namespace {

Points ellipse(int count) {
    Points points(3, count);
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        points.col(k) << 2.0 * std::cos(angle), std::sin(angle), 0.5 * std::cos(angle);
    }
    return points;
}

Indices everything(int count) {
    Indices result;
    for (int k = 0; k < count; ++k) result.push_back(k);
    return result;
}

Patch with_pins(const test::Single& single, const Indices& pins) {
    const Patch& given = single.patch();
    Indices order;
    std::vector<char> is_pin(given.vertex_count(), 0);
    for (int v : pins) is_pin[v] = 1;
    for (const char wanted : {0, 1}) {
        for (int v = 0; v < given.free_count; ++v) {
            if (is_pin[v] == wanted) order.push_back(v);
        }
    }
    for (int v = given.free_count; v < given.vertex_count(); ++v) order.push_back(v);
    Indices to(order.size());
    PatchMembers members;
    members.free_count = given.free_count - static_cast<int>(pins.size());
    for (int k = 0; k < static_cast<int>(order.size()); ++k) {
        to[order[k]] = k;
        members.to_input.push_back(order[k]);
        members.pin.push_back(is_pin[order[k]]);
    }
    members.input_triangle = given.input_triangle;
    members.triangles = given.triangles.unaryExpr([&](int v) { return to[v]; });
    return Patch(std::move(members));
}

}  // namespace

TEST_CASE("an ellipse of even spacing is a fair border") {
    const int count = 40;
    const Points exact = ellipse(count);
    Points points = exact;
    fair_border(everything(count), std::vector<char>(count, 1), points);
    CHECK((points - exact).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("pins side by side are a curve, and change the equation") {
    const test::Single single = test::single_patch(test::grid(8, 0.0, test::flat));
    const int middle = single.patch().free_count / 2;
    const int beside = single.patch().ring(middle).vertices.front();
    const Patch apart = with_pins(single, {middle});
    const Patch curve = with_pins(single, {middle, beside});
    CHECK(isolated_pins(curve).empty());
    CHECK(equation_for(apart, Equation::harmonic) == Equation::harmonic);
    CHECK(equation_for(curve, Equation::harmonic) == Equation::least_variation);
    CHECK(equation_for(curve, Equation::soap_film) == Equation::soap_film);
}

TEST_CASE("triangles broken along an edge have a copy of its ends for each fan") {
    Triangles triangles(3, 4);  // a square around vertex 4
    triangles << 0, 1, 2, 3, 1, 2, 3, 0, 4, 4, 4, 4;
    const BrokenSurface whole = broken_along(triangles, 5, {});
    CHECK(whole.input_vertex.size() == 5);
    const BrokenSurface slit = broken_along(triangles, 5, {{0, 4}});
    CHECK(slit.input_vertex.size() == 6);  // 0 twice
    const BrokenSurface halves = broken_along(triangles, 5, {{4, 0}, {2, 4}});
    CHECK(halves.input_vertex.size() == 8);
    for (Eigen::Index c = 0; c < triangles.size(); ++c)
        CHECK(halves.input_vertex[halves.triangles(c % 3, c / 3)] == triangles(c % 3, c / 3));
}
