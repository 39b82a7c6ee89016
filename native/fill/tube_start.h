// A mesh of the tube between two boundary loops.
#pragma once

#include "start/swept_tube.h"

namespace fairing {

// New vertices, and triangles over them (first) and the boundary loops' vertices.
struct TubeMesh {
    Points points;  // 3 × new vertices
    Triangles triangles;
};

TubeMesh tube_start(const SweptTube& tube);

}  // namespace fairing
