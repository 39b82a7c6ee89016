// What fits tell, for all who look at them.
#pragma once

#include <cstddef>
#include <numbers>

namespace fairing {

// The nearest vertices that a fit looks at; a cubic with a free centre has ten unknowns.
inline constexpr std::size_t points_of_fit = 22;
// A normal turns by 60° at most: beyond, the points show another side.
inline constexpr double cos_of_widest_turn = 0.5;
// Of a triangle (1: equilateral), below which it carries no curvature: a right one of 7 : 1.
inline constexpr double poor_shape = 0.25;
// Radians that a patch fills around a vertex of its boundary: below, H there answers to the wedge as well.
inline constexpr double widest_corner = 2.0 * std::numbers::pi / 3.0;
// Standard error of a slope: exact fits have rounding for one.
inline constexpr double least_error = 1e-10;
// Of the edges around. Fixed vertices stay as near to each other as they were given, down to 3e-5 of an edge on voxel
// meshes and beside booleans, and a normal's error is divided by that distance.
inline constexpr double least_reported = 0.05;

}  // namespace fairing
