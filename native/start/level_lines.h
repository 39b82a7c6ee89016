// Level lines of functions on a patch.
#pragma once

#include "base/types.h"

namespace fairing {

// Cross-sections lie at these levels of functions that are 1 at one end and 0 at the other.
inline constexpr int line_count = 17;
constexpr double level_of(int line) {
    constexpr double first = 0.1;  // the last one as far from the other end
    return first + (1.0 - 2.0 * first) * line / (line_count - 1);
}

// The part of a level line within one triangle; without length elsewhere.
struct LevelPiece {
    double length = 0.0;
    Vector3 middle = Vector3::Zero();
};

// `values`: of all vertices; `points`: 3 × the same.
LevelPiece level_within(const Eigen::Vector3i& corners, const VectorX& values, double level, const Points& points);

}  // namespace fairing
