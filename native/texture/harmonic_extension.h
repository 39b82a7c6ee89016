// Values at some vertices of a surface, continued over it harmonically.
#pragma once

#include "base/types.h"

namespace fairing {

// (n × c): those `given` (k × c) at the `known` vertices, Δ = 0 at the others: cotangent weights of the intrinsic
// Delaunay triangulation, so that no value leaves the range of its column, up to rounding, and on a flat surface a
// linear function stays linear and how it is triangulated does not count. Nothing flows across a border that is not
// known. Where triangles are wound against each other, or three meet at an edge, the weights are the mesh's own, none
// below a thousandth. NaN at vertices that hang together with no known one. Throws SolverError; Cancelled.
Eigen::MatrixXd harmonic_extension(const Points& points, const Triangles& triangles, const Indices& known,
                                   const Eigen::MatrixXd& given);

}  // namespace fairing
