// Discs cut out of a surface and laid flat.
#pragma once

#include "geometry/frame.h"
#include "geometry/neighbourhood.h"

namespace fairing {

// From the first of the vertices to each (3 × k): in the plane across its unit normal, as long as the straight
// distance.
Points tangent_offsets(const Points& points, const Vector3& normal, const Indices& vertices);

// One disc at a time. Keeps references.
class Discs {
public:
    Discs(const Points& points, const Points& normals, const Triangles& triangles);

    // Cuts the disc around a vertex. What follows is about this one; offsets lie in its tangent plane.
    void cut(int centre, double radius);
    // The vertex next to an offset.
    [[nodiscard]] int nearest(const Vector3& offset) const;
    // Of a field (n) there: linear within the triangle at the nearest vertex that it lies in or next to.
    [[nodiscard]] double value(const VectorX& field, const Vector3& offset) const;

private:
    using Plane = Eigen::Vector2d;
    [[nodiscard]] Plane flat(const Vector3& offset) const { return {frame_.u.dot(offset), frame_.v.dot(offset)}; }
    [[nodiscard]] int box_of(const Plane& place, int axis) const;
    [[nodiscard]] std::size_t box(int x, int y) const { return (y * boxes_ + x); }
    [[nodiscard]] Vector3 corner_weights(int triangle, const Plane& place) const;

    const Points& points_;
    const Points& normals_;
    const Triangles& triangles_;
    VertexAdjacency around_;
    BallWalk walk_;
    std::vector<Indices> triangles_at_;
    Frame frame_{Vector3::UnitZ()};
    double radius_ = 0.0;
    int boxes_ = 1;            // along each side of the square around the disc
    Eigen::Matrix2Xd places_;  // of all vertices; those of the disc are up to date
    Indices cut_;              // the number of the cut that each vertex was in last
    int stamp_ = none;
    std::vector<Indices> in_box_;
};

}  // namespace fairing
