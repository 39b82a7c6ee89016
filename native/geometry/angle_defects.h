// Gaussian curvature by the angles around vertices.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// 2π minus the angles around each free vertex, the integral of its Gaussian curvature; zero at the others. `points`: 3
// × local vertices.
VectorX angle_defects(const Patch& patch, const Points& points);

// By how much, of 2π, a surface bends like a ball, or like a saddle: the lesser of both. By Gauss and Bonnet outlines
// with their slopes settle the difference. Waists, bulges and dents add as much of both; a tube bent by θ has θ / π.
double bent_both_ways(const Patch& patch, const Points& points);

}  // namespace fairing
