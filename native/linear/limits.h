// Limits that several solvers share.
#pragma once

#include <algorithm>
#include <limits>

namespace fairing {

// Differences that an accelerated iteration keeps, and the length of its longest step in units of D. Slides within a
// surface have a depth of their own.
inline constexpr int history_depth = 6;
inline constexpr double longest_step = 0.1;

// Line searches: how often a step is halved, and the share of the fall that its slope promises (Armijo).
inline constexpr int most_halvings = 12;
inline constexpr double armijo = 1e-4;

// Columns of a factor from which its fill counts: zeros are saved, and nested dissection leaves fewer than minimum
// degree.
inline constexpr int large_order = 5000;

// Rows and columns of a dense matrix that are worked on at once: what the cache holds.
inline constexpr int tile = 192;

// The residual that an iteration may leave, in the norm of its preconditioner: the smaller of both. Direct solves
// ignore it.
struct Accuracy {
    // With ten times that, hemispheres of 100k vertices need six outer iterations instead of four.
    double share = 0.003;
    double size = std::numeric_limits<double>::infinity();

    [[nodiscard]] double left_of(double whole) const {
        constexpr double least_share = 1e-4;  // for the sake of `size`: factors in single precision give no more
        return std::min(share * whole, std::max(size, least_share * whole));
    }
};

}  // namespace fairing
