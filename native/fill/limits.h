// What several steps of a new mesh keep to.
#pragma once

namespace fairing {

// Degrees. Promised are 25, so that what lies below 26 is worth a vertex more or less; moves and flips go on to 30.
inline constexpr double wanted_angle = 30.0;
inline constexpr double bad_angle = 26.0;
// Degrees between edges that stay: below, it is one triangle.
inline constexpr double sharp_corner = 75.0;
// Flips, splits and collapses make none higher.
inline constexpr int highest_valence = 8;
// Rounds of local changes over all of the mesh: later ones find next to nothing.
inline constexpr int most_rounds = 4;

}  // namespace fairing
