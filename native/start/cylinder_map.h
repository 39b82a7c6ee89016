// Where the vertices of a patch between two outlines lie on a cylinder.
#pragma once

#include <vector>

#include "mesh/patch.h"

namespace fairing {

// Rows: s from the first end to the last, then turns around.
using CylinderMap = Eigen::Matrix2Xd;

struct Unrolled {
    CylinderMap map;
    VectorX jumps;  // by how much the turns at the second end of each edge count less, seen from the first one
};

struct CreaseLine {
    int first;     // vertex at s = 0
    int last;      // at s = 1
    double share;  // its turns, up to whole ones
};

// Puts the vertices of a way through the patch near each line onto it, and eases the turns of the others in between.
// Gives which of the local vertices lie on the lines, their ends too.
std::vector<char> keep_creases(const Patch& patch, const std::vector<CreaseLine>& lines, Unrolled& flat);

}  // namespace fairing
