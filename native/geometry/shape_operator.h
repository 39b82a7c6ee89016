// Shape operators: how a surface's unit normal turns along it.
#pragma once

#include "geometry/face_geometry.h"
#include "geometry/mean_curvature.h"

namespace fairing {

// W with dn = W d for small steps d within the surface, a symmetric 3 × 3 tensor in space, 0 along the normal: the
// entries xx, yy, zz, xy, xz, yz of a vertex are a column. 1/R in the tangent plane of a sphere with outward normals.
// In single precision: it shapes the steps of an iteration, never the point where it ends.
using ShapeOperators = Eigen::Matrix<float, 6, Eigen::Dynamic>;

// W d of column i.
inline Eigen::Vector3f turn(const ShapeOperators& shapes, int i, const Eigen::Vector3f& d) {
    const auto w = shapes.col(i);
    return {w[0] * d.x() + w[3] * d.y() + w[4] * d.z(), w[3] * d.x() + w[1] * d.y() + w[5] * d.z(),
            w[4] * d.x() + w[5] * d.y() + w[2] * d.z()};
}

// W at the first `count` vertices, from the fitted curvature in the frames of their unit normals.
ShapeOperators shape_operators(const PatchCurvature& curvature, const Points& normals, int count);

// W at the free vertices, from the unit normals (3 × local vertices, 0 at pins) of their neighbours alone, by least
// squares: exact on spheres and cylinders with exact normals up to the square of the edges.
ShapeOperators shape_operators(const Patch& patch, const Points& points, const Points& normals);

// Virtual points that complete the curvature fit where neighbours are few or one-sided (paper §6.2).
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
