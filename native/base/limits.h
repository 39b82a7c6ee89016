// Limits of numbers and loops that are shared by all parts.
#pragma once

namespace fairing {

// Relative rounding error of sums of doubles whose exact value is zero.
inline constexpr double roundoff = 1e-14;
// Bound of steps for iterations that end by themselves after 5 to 40.
inline constexpr int most_iterations = 60;

// So few are sorted, searched or worked on one by one.
inline constexpr int one_by_one = 16;

}  // namespace fairing
