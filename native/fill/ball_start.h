// An initial surface for patches that bulge out far beyond their boundary.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Positions of all vertices of a patch with one loop: its flat mesh spread over the part of a ball that the boundary's
// normals ask for. `flat`: 3 × vertices, `normals`: unit, of the fixed ones. Returns nothing where the ball is smaller
// than that, since a flat initial surface is enough, and where the normals determine no ball.
std::optional<Points> ball_start(const Patch& patch, const Points& flat, const Points& normals);

}  // namespace fairing
