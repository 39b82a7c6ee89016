#include "boundary/closing.h"

#include "fairness/harmonic_values.h"
#include "geometry/neighbourhood.h"

namespace fairing {

Points closing_surface(const Points& points, const Triangles& triangles, const std::vector<char>& held) {
    const VertexAdjacency around(triangles, static_cast<int>(points.cols()));
    InnerWeights edges;
    for (int v = 0; v < static_cast<int>(points.cols()); ++v) {
        for (int k = around.begin[v]; k < around.begin[v + 1]; ++k) {
            if (around.neighbours[k] < v) edges.push_back({v, around.neighbours[k], 1.0});
        }
    }
    const auto found = harmonic_values({edges, held, points}, points.transpose());
    return found ? Points(found->transpose()) : points;
}

}  // namespace fairing
