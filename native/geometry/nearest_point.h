// Nearest points of one triangle, and of many.
#pragma once

#include "base/types.h"

namespace fairing {

using Corners = std::array<Vector3, 3>;

// Barycentric coordinates of the point's projection onto the triangle's plane; negative outside of the triangle.
// Thirds where it has no area.
Vector3 plane_weights(const Vector3& p, const Corners& corners);
// Those of the nearest point on the triangle's edges: all but two are 0, at a corner all but one.
Vector3 border_weights(const Vector3& p, const Corners& corners);
// Those of the nearest point of the triangle.
Vector3 nearest_weights(const Vector3& p, const Corners& corners);

struct NearestPlace {
    int triangle;
    Vector3 weights;  // barycentric
    Vector3 foot;
};

// Finds the nearest point of some triangles.
class NearestTriangles {
public:
    // `chosen`: their numbers, one at least. Keeps references to the arrays.
    NearestTriangles(const Points& points, const Triangles& triangles, const Indices& chosen);
    ~NearestTriangles();
    NearestTriangles(const NearestTriangles&) = delete;
    NearestTriangles& operator=(const NearestTriangles&) = delete;
    [[nodiscard]] NearestPlace to(const Vector3& p) const;

private:
    struct Boxes;
    const Points& points_;
    const Triangles& triangles_;
    std::unique_ptr<const Boxes> boxes_;
};

// Distance of each column of `at` to the triangle surface: positive on the side from which triangles are
// counter-clockwise. The side is that of the normal at the nearest point, on an edge or a corner the sum of the normals
// around weighted by their angles (Baerentzen and Aanaes 2005), which is right on every closed surface. At least one
// triangle; all finite.
VectorX signed_distances(const Points& at, const Points& points, const Triangles& triangles);

}  // namespace fairing
