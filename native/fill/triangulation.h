// The cheapest triangulation of a closed polygon in space.
#pragma once

#include "base/types.h"

namespace fairing {

// What a triangle of three columns of `points` costs: its area, and a thousandth of its squared edges, which decides
// between triangulations of one area (a flat polygon has many). Where `directions` from a centre are given, a triangle
// that is clockwise seen from there costs more than all others together, since it would lie behind others.
class TriangleCost {
public:
    explicit TriangleCost(const Points& points) : points_(points) {}
    // `outward`: −1 where counter-clockwise is meant as seen from the centre, 1 as seen from outside.
    TriangleCost(const Points& points, Points directions, double outward);

    // The same, but a triangle's area costs more the further it leans away from these normals at its corners. Keeps a
    // reference to the normals.
    [[nodiscard]] TriangleCost along(const Points& normals) const;

    [[nodiscard]] double operator()(int a, int b, int c) const;

private:
    [[nodiscard]] double lean(const Vector3& area, int a, int b, int c) const;

    const Points& points_;
    const Points* normals_ = nullptr;
    Points directions_;  // no columns: not used
    double outward_ = 1.0;
    double dear_ = 0.0;
};

// Triangles over the polygon's corners (columns of the points), wound as the polygon is. Dynamic programming over all
// chords (G. T. Klincsek 1980), O(n³), up to 400 corners. Of longer polygons 200 corners are taken first, and what lies
// between two of these is triangulated by itself; a corner that the polygon passes twice is always among them. Passes
// checkpoints.
std::vector<Eigen::Vector3i> cheapest_triangulation(const Indices& polygon, const TriangleCost& cost);

}  // namespace fairing
