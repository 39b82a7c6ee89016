// Limits that several solvers share.
#pragma once

namespace fairing {

// Differences that an accelerated iteration keeps, and the length of its longest step in units of D. Spread pins and
// slides within a surface have limits of their own.
inline constexpr int history_depth = 6;
inline constexpr double longest_step = 0.1;

// Rows and columns of a dense matrix that are worked on at once: what the cache holds.
inline constexpr int tile = 192;

}  // namespace fairing
