// shape/ for whole meshes, by input vertices. Positions must be finite.
#pragma once

#include "api/input.h"
#include "shape/girth.h"

namespace fairing {

// The worst of all pieces; nothing where none has several loops.
std::optional<GirthRange> girth(const MeshInput& input);
// By input vertices.
GirthRange by_input(const Patch& patch, GirthRange range);

}  // namespace fairing
