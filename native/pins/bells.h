// Bells on a surface: 1 at a vertex, falling off within a radius.
#pragma once

#include "base/progress.h"
#include "geometry/face_geometry.h"
#include "mesh/patch.h"

namespace fairing {

// Diffuses a unit of heat at each of the vertices for the time ρ²/2, in eight implicit steps, and scales it to 1 there:
// nearly a Gaussian of standard deviation ρ in the distance along the surface. It does not reach across a slit or a
// thin wall. 3 × vertices of the patch, units of the radius; vertices × centres come back. Throws SolverError where the
// surface has degenerated.
Eigen::MatrixXd bells(const Patch& patch, const Points& points, const Stiffness& stiffness, const Indices& centres,
                      double radius, const Progress& progress);

}  // namespace fairing
