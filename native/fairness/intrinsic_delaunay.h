// Intrinsic Delaunay triangulation of a surface: flips change edges, never the geometry.
#pragma once

#include "fairness/inner_weights.h"

namespace fairing {

// A triangulation known by its edge lengths alone (Bobenko & Springborn 2007; Fisher et al. 2007). Edges may join a
// vertex to itself, and two vertices may share several edges.
class IntrinsicTriangulation {
public:
    // Precondition: triangles consistently wound, no edge with more than two.
    IntrinsicTriangulation(const Triangles& triangles, const Points& points);

    // Flips until cot α + cot β ≥ 0 at all inner edges; a bound on the number of flips keeps round-off from cycling.
    void make_delaunay();

    // cot α + cot β of each edge; ≥ 0 after make_delaunay up to round-off, clamped to a small positive multiple of
    // the mean, so that a degenerate reference still gives a definite matrix.
    [[nodiscard]] InnerWeights cotangent_weights() const;

private:
    // Side h = 3 t + k of triangle t leads from tail[h] to the tail of the triangle's next side.
    [[nodiscard]] static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
    // Cotangent of the angle opposite to side h.
    [[nodiscard]] double opposite_cotangent(int h) const;
    [[nodiscard]] double cotangent_sum(int h) const;
    bool flip(int h);
    void place_triangle(int t, std::array<int, 3> tails, std::array<double, 3> lengths, std::array<int, 3> twins);

    Indices tail_;
    Indices twin_;
    std::vector<double> length_;
};

}  // namespace fairing
