// Flat maps of surfaces that keep angles as far as they can.
#pragma once

#include "base/types.h"

namespace fairing {

// (n × 2): places in the plane for the vertices of a surface, those `given` (k × 2) at the `fixed` ones. The others
// take those of the least squares conformal map (Lévy et al. 2002): borders that are not fixed are free. Triangles that
// are counter-clockwise stay so, as far as the places given allow. With a border that is fixed all around, it is the
// harmonic map with cotangent weights. Throws SolverError where the map is not determined: a piece of the mesh without
// two fixed vertices, or without area. Precondition: each vertex has a triangle.
Eigen::MatrixXd conformal_map(const Points& points, const Triangles& triangles, const Indices& fixed,
                              const Eigen::MatrixXd& given);

}  // namespace fairing
