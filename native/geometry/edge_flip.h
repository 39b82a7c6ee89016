// Whether the edge that two triangles share should be replaced by the other diagonal.
#pragma once

#include "geometry/area_vector.h"
#include "geometry/cotangent.h"
#include "geometry/limits.h"

namespace fairing {

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

}  // namespace fairing
