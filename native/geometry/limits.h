// Where fitted normals and curvatures can be trusted; shared by all who use them.
#pragma once

#include <cstddef>
#include <numbers>

namespace fairing {

// The nearest vertices that a fit looks at; a cubic with a free centre has ten unknowns.
inline constexpr std::size_t points_of_fit = 22;
// A fitted normal turns by 60° at most: beyond, the points belong to another side of the surface.
inline constexpr double cos_of_widest_turn = 0.5;
// Shape of a triangle (1: equilateral) below which it carries no curvature: a right one of 7 : 1.
inline constexpr double poor_shape = 0.25;
// Radians that a patch fills around a boundary vertex: below, H there depends on this angle as well.
inline constexpr double widest_corner = 2.0 * std::numbers::pi / 3.0;
// Least standard error of a slope: that of an exact fit is rounding.
inline constexpr double least_error = 1e-10;
// Share of the edges around. Fixed vertices may be as near to each other as 3e-5 of an edge (voxel meshes, seams of
// booleans), and a normal's error is divided by that distance.
inline constexpr double least_reported = 0.05;

}  // namespace fairing
