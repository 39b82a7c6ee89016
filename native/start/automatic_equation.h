// Which equation suits a patch, by its boundary loops alone.
#pragma once

#include <vector>

#include "problem/problem.h"

namespace fairing {

// Tubes of more radii than this are solved by least variation (tube_length). Of straight pipes, elbows and S-bends
// (docs/least_variation) none up to this length is thinner by more than .03 of a radius than least variation makes it;
// elbows of 2.4 are by .06, of 3 by .13, of 4 by .3.
inline constexpr double longest_harmonic_tube = 2.0;

// Equation::automatic means: least variation between two loops that face each other along a tube of more than
// `longest_harmonic_tube` radii, where harmonic surfaces have waists and balloons; harmonic elsewhere. `loops`: columns
// of `points` and `normals` (3 × boundary vertices), the surface on their left.
Equation automatic_equation(const std::vector<Indices>& loops, const Points& points, const Points& normals);

}  // namespace fairing
