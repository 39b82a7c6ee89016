// Vertices that the boundary of a surface passes several times: split while it is made, and welded again.
#pragma once

#include "fill/loop_sides.h"

namespace fairing {

// A boundary that passes each vertex once: copies of the n vertices come after these.
struct SplitBoundary {
    std::vector<Indices> loops;
    Points placed;   // n + c, as they are
    Points parted;   // likewise; those passed several times lie a little into the surface, so that its first mesh
                     // has room between them
    Indices source;  // the vertex that each is

    [[nodiscard]] int count() const { return static_cast<int>(source.size()); }
    [[nodiscard]] Indices fixed() const;

    // The number of one of these, or of a new one behind them, among the n vertices and new ones behind those.
    [[nodiscard]] int welded(int vertex) const;

    int old_count = 0;  // n
};

SplitBoundary split_boundary(const std::vector<BoundaryLoop>& loops, const Points& points);

}  // namespace fairing
