// From where on a surface looks wrong: one limit for each question, for the engine and the add-on alike.
#pragma once

namespace fairing {

// Radii of the thinnest and of the thickest cross-section over what they come from, from which a tube has a waist or a
// balloon. An elbow of 70° with .85 was sent back, pipes of two and a half radii with .94 were not; three arms that
// meet have 1.3, and so have pipes of three radii whose ends lean outwards by 15°.
inline constexpr double waist = 0.9;
inline constexpr double balloon = 1.4;

// How much more a place is bent than the most bent one on the boundary that is a spot.
inline constexpr double sharp_bend = 2.0;

// Degrees by which a hard edge becomes flatter that is rounded off; edges of its chain that do, and that stay, at
// least; what other edges of the same triangles may bend, of its own bend: the rims of fins and folds of skin are
// round; the share of all edges that may be marked.
inline constexpr double flatter = 15.0;
inline constexpr int runs_on = 2;
inline constexpr double most_beside = 0.12;
inline constexpr double most_marked = 0.25;

// Degrees of a kink along the boundary beyond the bends that are usual around (shape/visible_join), from which it is
// seen: among faces that bend as most do, among faces that hardly bend, and whatever these do.
inline constexpr double visible_kink = 12.0;
inline constexpr double finest_kink = 5.0;
inline constexpr double steep_kink = 30.0;
// The share of the boundary that kinks have at least. Of 308 results 8 of 12 above it were sent back or doubted, of ten
// shorter and steeper kinks four.
inline constexpr double kink_share = 0.125;
// From which it is none: the surface turns back.
inline constexpr double turned_back = 90.0;
// Degrees between a surface's normal on the boundary and the one prescribed, from which it leaves its surroundings.
// Coarse meshes show no kink there.
inline constexpr double off_slope = 20.0;

}  // namespace fairing
