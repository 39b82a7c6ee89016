// What the parts of a fillet share.
#pragma once

namespace fairing {

// Radians. Normals that turn by less are a plane's: fits to planes agree to 1e-6, those to arcs turn more; by 20° or
// more at one place, or from one point of a line to the next, they are of two sides.
inline constexpr double straight_angle = 1e-3;
inline constexpr double corner_angle = 0.35;
// In spacings: next to longer edges the new mesh has slivers.
inline constexpr double longest_edge = 2.0;
// In spacings: shorter edges and lower triangles bring thin ones for no gain, and stop a mesh that is made even.
inline constexpr double snap = 0.02;

}  // namespace fairing
