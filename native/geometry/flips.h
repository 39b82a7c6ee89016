// Triangles that are turned over against those around them.
#pragma once

#include "base/types.h"
#include "geometry/limits.h"
#include "geometry/triangle.h"
#include "mesh/patch.h"

namespace fairing {

// Local numbers, ascending, of the triangles whose normal points against the mean of Max's normals at their corners.
// `points`: 3 × local vertices.
Indices flipped_triangles(const Patch& patch, const Points& points);

// The same without those that have no free corner: the boundary alone turns them, no solution can turn them back.
Indices flipped_by_solution(const Patch& patch, const Points& points);

// Whether one triangle is.
bool is_flipped(const Patch& patch, const Points& points, int triangle);

// Whether the edge that two triangles share should be replaced by the other diagonal.
// Times the length wanted: longer edges are split. A half of one is as much too short as the whole is too long.
inline constexpr double split_above = 4.0 / 3.0;

// The edge from a to b with the triangles (a, b, c) and (b, a, d).
struct Diagonal {
    Vector3 a, b, c, d;

    // cot α + cot β ≥ 0 of the angles at c and d, up to round-off.
    [[nodiscard]] bool is_delaunay() const {
        constexpr double slack = -1e-9;  // rounding of two cotangents
        return !(cotangent(a - c, b - c) + cotangent(a - d, b - d) < slack);
    }

    // A flip may not bend the mesh by more than 60°, or further than it is bent.
    [[nodiscard]] bool flips_without_fold() const {
        const double after = cos_of_bend(area_vector(c, d, b), area_vector(d, c, a));
        return after >= cos_of_widest_turn || after >= cos_of_bend(area_vector(a, b, c), area_vector(b, a, d));
    }

private:
    static double cos_of_bend(const Vector3& n, const Vector3& m) { return n.dot(m) / (n.norm() * m.norm() + 1e-300); }
};

// Triangles without area that have a vertex over their longest side, as booleans leave them.
// What stood in a triangle list before and after: `cap` became, with the triangle `beside` over its longest side, two
// triangles of that one's plane. `ends` of that side, which is no more, and the vertex `over` it, that parts it now.
struct TurnedCap {
    int cap, beside;
    std::array<int, 2> ends;
    int over;
};

// Turns the longest side of each triangle marked in `may_turn` that is lower over it than `least`, or than 1e-5 of it,
// while its sides are longer; the triangle beside has to be marked in `may_take`. In the order in which they were
// turned: a side with several vertices over it is parted by one after the other.
std::vector<TurnedCap> turn_caps(const Points& points, const std::vector<char>& may_turn,
                                 const std::vector<char>& may_take, double least, Triangles& triangles);

}  // namespace fairing
