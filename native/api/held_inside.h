// Checks of the vertices whose slope the surface finds.
#pragma once

#include "api/input.h"

namespace fairing {

// Whether each vertex of the input is named. Throws INDEX_RANGE with the option's name.
std::vector<char> marks_of(const MeshInput& input, const Indices& vertices, const char* name);

// Throws std::invalid_argument for a vertex that is not fixed, or is given both kinds of slopes.
void check_slopes(const GivenRoles& given, const VertexRoles& roles);

}  // namespace fairing
