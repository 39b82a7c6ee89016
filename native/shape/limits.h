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

// Of 2π: by how much a knob bends like a ball, and its neck like a saddle; an elbow of 90° has as much.
inline constexpr double least_knob = 0.25;
// Of what the old surface had of it: one with less is an improvement, whatever it is.
inline constexpr double calmer = 0.8;

// Degrees by which a patch bends over, and its surroundings bend back, on average where its boundary is on a flank;
// degrees from which a place there counts, and how many of the places do. They miss half of the bumps that stay
// (docs/blender.md).
inline constexpr double flank_over = 4.0;
inline constexpr double flank_back = 6.0;
inline constexpr double seen_lean = 3.0;
inline constexpr double most_over = 0.7;
inline constexpr double most_back = 0.75;
inline constexpr double flank_end = 0.9;  // of the largest lean
// Degrees between a boundary's normals and the way that the patch faces, in the mean: a limb has 90, the flanks of
// bumps up to 50.
inline constexpr double steepest_flank = 65.0;

// Degrees by which a hard edge becomes flatter that is rounded off; edges of its chain that do, and that stay, at
// least; what other edges of the same triangles may bend, of its own bend: the rims of fins and folds of skin are
// round; the share of all edges that may be marked.
inline constexpr double flatter = 15.0;
inline constexpr int runs_on = 2;
inline constexpr double most_beside = 0.12;
inline constexpr double most_marked = 0.25;

// Of a triangle's longest side: a height below is none. Degrees between its neighbours on what counts as a plane.
inline constexpr double needle_height = 1e-3;
inline constexpr double flat_bend = 1.0;

// A vertex over its neighbours' mean, in edges: scans, CAD and characters have up to 1.3, a spike of three edges has
// 2.7. In the median, of 180 random patches of 14 meshes none is crumpled, with noise of a tenth of an edge one in 25,
// of a quarter five in six, of a half all. What is as rough all around has a texture all the same.
inline constexpr double spike = 1.6;
inline constexpr double crumpled = 0.25;
inline constexpr double rougher = 2.0;

// Degrees by which the normals of a skin turn, in the median, that is seen; the upper over the lower quartile of even
// grain, which is 2.2 where normals turn at random (a Rayleigh distribution) and 2.8 and more where features do it; and
// the share of it that is none. Chosen on the first half of benchmarks/verdicts.
inline constexpr double seen_grain = 2.5;
inline constexpr double even_grain = 2.6;
inline constexpr double lost_grain = 1.0 / 3.0;
// The share of a patch's edges that bend more than those around from which it is crumpled: .2 and more where it is, .13
// at most where it isn't (benchmarks/verdicts, both halves).
inline constexpr double crumpled_share = 0.16;

// How deep a surface sinks below the lines that run on across it, of their length (shape/knobs): those that were kept
// come to .018 at most on the first half of benchmarks/verdicts, bevels and handles that lose their girth to .026 and
// .07.
inline constexpr double sunken = 0.02;

// Degrees of a kink along the boundary beyond the bends that are usual around (shape/visible_join), from which it is
// seen: among faces that bend as most do, among faces that hardly bend, and whatever these do.
inline constexpr double visible_kink = 12.0;
inline constexpr double finest_kink = 5.0;
inline constexpr double steep_kink = 30.0;
// Times the degrees from which it is seen: what neighbouring vertices add up to at least. A short kink must be steep.
inline constexpr double kink_length = 5.0;
// From which it is none: the surface turns back.
inline constexpr double turned_back = 90.0;
// Degrees between a surface's normal on the boundary and the one prescribed, from which it leaves its surroundings.
// Coarse meshes show no kink there.
inline constexpr double off_slope = 20.0;

}  // namespace fairing
