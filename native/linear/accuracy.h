// How far linear systems are solved.
#pragma once

#include <algorithm>
#include <limits>

namespace fairing {

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
