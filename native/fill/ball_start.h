// A start for what bulges out far beyond its boundary.
#pragma once

#include <optional>

#include "mesh/patch.h"

namespace fairing {

// Positions of all vertices of a patch with one loop: its flat mesh spread over the part of a ball that the boundary's
// normals ask for. `flat`: 3 × vertices, `normals`: unit, of the fixed ones. Nothing where the ball is narrower than
// that: a flat start does. Nothing either where the normals name no ball.
std::optional<Points> ball_start(const Patch& patch, const Points& flat, const Points& normals);

}  // namespace fairing
