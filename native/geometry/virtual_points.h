// Virtual points that complete the curvature fit where neighbours are few or one-sided (paper §6.2).
#pragma once

#include "geometry/face_geometry.h"

namespace fairing {

// The chord from a to b with the vertex normals at its ends and the sum of the unit normals of the triangles at it
// (on a border edge the single one).
template <typename Scalar>
struct NormalChordOf {
    Vector3Of<Scalar> a;
    Vector3Of<Scalar> b;
    Vector3Of<Scalar> normal_a;
    Vector3Of<Scalar> normal_b;
    Vector3Of<Scalar> triangle_normals;
};
using NormalChord = NormalChordOf<double>;

// The point between a and b, midway between the two circular arcs that leave a and b along the tangents in the
// plane of the chord and `triangle_normals` (paper §6.2). On a straight line it is the midpoint, exactly; continuous
// in all its arguments while the triangle normals don't cancel.
Vector3 virtual_point(const NormalChord& chord);

// The virtual point of an edge of a patch. It is the same from either end.
Vector3 edge_virtual_point(const Patch& patch, const Points& points, const FaceGeometry& faces, const Points& normals,
                           int edge);

// The virtual points of all edges.
Points edge_virtual_points(const Patch& patch, const Points& points, const FaceGeometry& faces, const Points& normals);

}  // namespace fairing
