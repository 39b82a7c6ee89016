// Gathers the points around a vertex of a patch into contiguous scratch memory.
#pragma once

#include <vector>

#include "geometry/vertex_normal.h"

namespace fairing {

class OneRingBuffer {
public:
    // Valid until the next call.
    OneRing gather(const Patch& patch, const Points& points, int vertex) {
        const RingView ring = patch.ring(vertex);
        points_.clear();
        for (int v : ring.vertices) points_.emplace_back(points.col(v));
        return {points.col(vertex), points_, ring.closed()};
    }

    // Appends virtual_point(edge) for each rim edge of the ring gathered last.
    template <typename VirtualPoint>
    std::span<const Vector3> with_virtual(const Patch& patch, int vertex, const VirtualPoint& virtual_point) {
        for (int edge : patch.ring(vertex).rim) points_.emplace_back(virtual_point(edge));
        return points_;
    }

private:
    std::vector<Vector3> points_;
};

}  // namespace fairing
