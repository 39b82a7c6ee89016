#include "boundary/closing.h"

#include "geometry/neighbourhood.h"
#include "linear/conjugate_gradients.h"

namespace fairing {

Points closing_surface(const Points& points, const Triangles& triangles, const std::vector<char>& held) {
    constexpr double accuracy = 1e-6;  // flat loops give exact zeros across; others need a direction alone
    const auto count = static_cast<int>(points.cols());
    const VertexAdjacency around(triangles, count);
    const auto is_free = [&](int v) { return !held[v] && around.begin[v] < around.begin[v + 1]; };
    Vector3 centre = Vector3::Zero();
    int boundary = 0;
    for (int v = 0; v < count; ++v) {
        if (!held[v] || around.begin[v] == around.begin[v + 1]) continue;
        centre += points.col(v);
        ++boundary;
    }
    if (boundary == 0) return points;
    centre /= boundary;
    Points pull = Points::Zero(3, count);  // of what is held, from the centre
    VectorX degree = VectorX::Ones(count);
    for (int v = 0; v < count; ++v) {
        if (!is_free(v)) continue;
        degree[v] = around.begin[v + 1] - around.begin[v];
        for (int k = around.begin[v]; k < around.begin[v + 1]; ++k) {
            const int other = around.neighbours[k];
            if (held[other]) pull.col(v) += points.col(other) - centre;
        }
    }
    const auto apply = [&](const Points& p, Points& q) {
        for_ranges(count, fine_grain, [&](int begin, int end) {
            for (int v = begin; v < end; ++v) {
                q.col(v) = degree[v] * p.col(v);
                if (!is_free(v)) continue;
                for (int k = around.begin[v]; k < around.begin[v + 1]; ++k) {
                    if (is_free(around.neighbours[k])) q.col(v) -= p.col(around.neighbours[k]);
                }
            }
        });
    };
    const auto precondition = [&](const Points& r, Points& z) { z = r * degree.cwiseInverse().asDiagonal(); };
    const Points offsets = conjugate_gradients(pull, accuracy, most_cycles, apply, precondition).x;
    Points result = points;
    for (int v = 0; v < count; ++v) {
        if (is_free(v)) result.col(v) = centre + offsets.col(v);
    }
    return result;
}

}  // namespace fairing
