// Limits of numbers and loops, whatever they are about.
#pragma once

namespace fairing {

// Relative: what sums of doubles leave of a zero.
inline constexpr double roundoff = 1e-14;
// Of iterations that end by themselves in 5 to 40 steps.
inline constexpr int most_iterations = 60;

// So few are sorted, searched or worked on one by one.
inline constexpr int one_by_one = 16;

}  // namespace fairing
