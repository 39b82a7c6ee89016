// Level lines of functions on a patch.
#pragma once

#include "base/types.h"

namespace fairing {

// The part of a level line within one triangle; without length elsewhere.
struct LevelPiece {
    double length = 0.0;
    Vector3 middle = Vector3::Zero();
};

// `values`: of all vertices; `points`: 3 × the same.
LevelPiece level_within(const Eigen::Vector3i& corners, const VectorX& values, double level, const Points& points);

}  // namespace fairing
