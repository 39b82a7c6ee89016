// How far an outline has moved since the last solve.
#pragma once

#include <optional>

#include "problem/problem.h"

namespace fairing {

// 3 × fixed count each, units of D; pins have no normal.
struct Outline {
    Points points;
    Points normals;
};

Outline outline_of(const Problem& problem);

// The rotation that takes one outline nearest to a later one (Kabsch 1976). Nothing where a point is then more than
// 0.05 D or a normal more than 45° away: the last answer says little about the next one.
std::optional<Eigen::Matrix3d> small_rotation(const Outline& last, const Outline& present);

}  // namespace fairing
