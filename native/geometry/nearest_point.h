// Nearest points of one triangle, and of many.
#pragma once

#include <array>

#include "base/types.h"

namespace fairing {

using Corners = std::array<Vector3, 3>;

// Barycentric coordinates of the foot of the perpendicular on the triangle's plane; negative outside of it. Without an
// area: thirds.
Vector3 plane_weights(const Vector3& p, const Corners& corners);
// Of the nearest point of the triangle's border. All but two of them are 0, at a corner all but one.
Vector3 border_weights(const Vector3& p, const Corners& corners);
// Of the nearest point of the triangle.
Vector3 nearest_weights(const Vector3& p, const Corners& corners);

// Distance of each column of `at` to the triangle surface: positive on the side from which triangles are
// counter-clockwise. The side is that of the normal at the nearest point, on an edge or a corner the sum of the normals
// around weighted by their angles (Baerentzen and Aanaes 2005), which is right on every closed surface. At least one
// triangle; all finite.
VectorX signed_distances(const Points& at, const Points& points, const Triangles& triangles);

}  // namespace fairing
