// Dihedral angles of a triangle list, and the range that is usual near each edge.
#pragma once

#include "mesh/edges.h"

namespace fairing {

// The usual range of angles, degrees.
struct AngleRange {
    double low = 0.0;
    double high = 0.0;

    // By how much an angle lies outside the range.
    [[nodiscard]] double excess(double angle) const;
    void include(double angle);
    void include(const AngleRange& other);
};

// Degrees between the faces of an edge from a on: positive where the surface is convex, seen from the side of the
// normals. `first` and `second` are the unit normals, `opposite` the third corner of the second triangle.
double dihedral_angle(const Vector3& first, const Vector3& second, const Vector3& a, const Vector3& opposite);

// An edge with one triangle on either side: sides 3 t + k of two lists.
struct Meeting {
    std::array<int, 2> ends;
    int inside;
    int outside;
};

std::vector<Meeting> meetings(const EdgeTable& inside, const EdgeTable& outside);

class DihedralBands {
public:
    struct WeightedAngle {
        double angle;
        double weight;
        int edge;
    };

    // Precondition: three different indices in each triangle. Keeps references.
    DihedralBands(const Points& points, const Triangles& triangles);

    [[nodiscard]] const EdgeTable& edges() const { return edges_; }
    [[nodiscard]] const Points& normals() const { return normals_; }  // of the triangles; zero without area
    // The angle at edge e, in the winding of its first triangle; zero unless it has two triangles.
    [[nodiscard]] double angle(int edge) const { return angles_[edge]; }
    // The bend over three rows about the edge's direction, between the triangles beyond the vertices opposite to it.
    // Zero where these bend to the other side.
    [[nodiscard]] double angle_over_rows(int edge) const;
    // Marks of the triangles visited around the last edge; one for each thread.
    struct Walk {
        Indices vertices;
        Indices triangles;
        Indices edges;
        int stamp = 0;
    };
    [[nodiscard]] Walk walk() const;
    static constexpr int rings = 3;  // of triangles around an edge
    // The usual bends across an edge (a, b): zero and the middle half of the angles within these rings, weighted by the
    // edges' lengths and their squared cosines with it. So only edges along a tube say how it bends around, whatever
    // its proportions.
    [[nodiscard]] AngleRange usual(int a, int b, Walk& walk) const;
    // The middle half likewise on the other side of zero, and up to `share` on the edge's own. On the other side, edges
    // marked in `between_planes` (between plane faces) don't count: the upper edge of a letter's wall is no noise for
    // the lower one.
    [[nodiscard]] AngleRange usual_across(int edge, double share, const std::vector<char>& between_planes,
                                          Walk& walk) const;
    // Whether an edge lies between two plane faces of several triangles, one of them of a solid.
    [[nodiscard]] bool is_between_planes(int edge) const;
    static constexpr double half = 0.75;  // the share up to which the middle half goes
    // By how much the surface bends across the edge more than in the adjacent rows, in degrees per length: over both
    // sides together, and on the side where it bends less. Empty where less than one row's share is near.
    struct Curvatures {
        double mean;
        double least;
    };
    [[nodiscard]] std::optional<Curvatures> curvatures_beyond(int edge, Walk& walk) const;
    [[nodiscard]] double mean_height(int edge) const;  // of its triangles, with the edge as base

private:
    void measure_edges();
    void measure(int edge);
    [[nodiscard]] double area(int triangle) const;
    // `is_of_solid`: the face is more than a quad, or the mesh bends at each of its other sides by at least half as
    // much as at this one. (Single quads of a grid over a curved surface may be plane, too.)
    struct PlaneFace {
        bool has_several;  // triangles
        bool is_of_solid;
    };
    [[nodiscard]] PlaneFace plane_face(int side) const;
    [[nodiscard]] double weight_across(int edge, const Vector3& along) const;
    // Some edges by their angles, weighted as in `usual_across`.
    [[nodiscard]] std::vector<WeightedAngle> weighted(const Indices& edges, int a, int b) const;
    [[nodiscard]] Vector3 normal_beyond(int side) const;
    [[nodiscard]] Indices inner_edges(const Indices& triangles, Walk& walk) const;  // with two triangles, each once
    [[nodiscard]] Indices triangles_near(int a, int b, Walk& walk) const;

    const Points& points_;
    const Triangles& triangles_;
    EdgeTable edges_;
    Points normals_;
    VectorX angles_;
    VectorX lengths_;
    Points directions_;  // of the edges, from the smaller number to the larger
    Indices begin_;      // of each vertex in `at_vertex_`
    Indices at_vertex_;
};

}  // namespace fairing
