// The part of a patch around some of its vertices, as a triangle list of its own.
#pragma once

#include "mesh/patch.h"

namespace fairing {

struct Strip {
    Indices vertices;     // of the patch, ascending
    Indices local;        // vertex of the patch → its number in the strip, `none` where it is not there
    Triangles triangles;  // in the strip's numbers, in the patch's order

    // Columns of the strip's vertices.
    [[nodiscard]] Points gather(const Points& points) const { return points(Eigen::all, vertices); }
};

// All triangles of the vertices that are reached from `seeds` by so many edges.
Strip strip_around(const Patch& patch, const Indices& seeds, int edges);

}  // namespace fairing
