// Triangles that are turned over relative to their neighbours, and flips of edges that mend them.
#pragma once

#include "base/types.h"
#include "geometry/limits.h"
#include "geometry/triangle.h"
#include "mesh/patch.h"

namespace fairing {

// Local numbers, ascending, of the triangles whose normal points against the mean of Max's normals at their corners.
// `points`: 3 × local vertices.
Indices flipped_triangles(const Patch& patch, const Points& points);

// The same without triangles that have no free corner: the boundary turns them over, and no solution can help.
Indices flipped_by_solution(const Patch& patch, const Points& points);

// The triangles on both sides of edges between free vertices that bend by more than 60°: where hard edges end at the
// boundary, those that come to it may.
Indices folded_triangles(const Patch& patch, const Points& points);

// Whether one triangle is turned over.
bool is_flipped(const Patch& patch, const Points& points, int triangle);

// Whether the edge that two triangles share should be replaced by the other diagonal.
// Edges longer than this multiple of the target length are split: halves are then a third too short at most.
inline constexpr double split_above = 4.0 / 3.0;

// The edge from a to b with the triangles (a, b, c) and (b, a, d).
struct Diagonal {
    Vector3 a, b, c, d;

    // cot α + cot β ≥ 0 of the angles at c and d, up to round-off.
    [[nodiscard]] bool is_delaunay() const {
        constexpr double slack = -1e-9;  // rounding of two cotangents
        return !(cotangent(a - c, b - c) + cotangent(a - d, b - d) < slack);
    }

    // A flip may not leave a dihedral angle above 60° unless the old one was larger.
    [[nodiscard]] bool flips_without_fold() const {
        const double after = cos_of_bend(area_vector(c, d, b), area_vector(d, c, a));
        return after >= cos_of_widest_turn || after >= cos_of_bend(area_vector(a, b, c), area_vector(b, a, d));
    }

private:
    static double cos_of_bend(const Vector3& n, const Vector3& m) { return n.dot(m) / (n.norm() * m.norm() + 1e-300); }
};

// Triangles without area that have a vertex over their longest side, as booleans leave them.
// One flip: `cap` and the triangle `beside` it across its longest side became two triangles in the latter's plane.
// `ends`: of that side, which is gone; `over`: the cap's vertex over it, which splits it now.
struct TurnedCap {
    int cap, beside;
    std::array<int, 2> ends;
    int over;
};

// Flips the longest side of each triangle marked in `may_turn` whose height over it is below `least` or 1e-5 of that
// side, while its sides are longer; the adjacent triangle has to be marked in `may_take`. Returns the flips in order:
// a side with several vertices over it is split by one after the other.
std::vector<TurnedCap> turn_caps(const Points& points, const std::vector<char>& may_turn,
                                 const std::vector<char>& may_take, double least, Triangles& triangles);

}  // namespace fairing
