#include "placement/follow_outline.h"

#include <algorithm>
#include <numeric>

#include "geometry/area_vector.h"

namespace fairing {

namespace {

// Of the neighbours one row nearer to the outline.
Vector3 mean_move(const Patch& patch, const Points& moves, const Indices& row, int vertex) {
    Vector3 sum = Vector3::Zero();
    int count = 0;
    for (const int w : patch.ring(vertex).vertices) {
        if (row[w] != row[vertex] - 1) continue;
        sum += moves.col(w);
        ++count;
    }
    return sum / count;
}

// Of all vertices; each row moves half as far as the mean of what it touches in the row before.
Points following(const Patch& patch, const Points& offsets) {
    constexpr int rows = 3;        // the last moves by an eighth
    constexpr double share = 0.5;  // of the row before
    Points moves = Points::Zero(3, patch.vertex_count());
    moves.rightCols(offsets.cols()) = offsets;
    Indices row(patch.vertex_count(), none);
    std::fill(row.begin() + patch.free_count, row.end(), 0);
    Indices last(patch.vertex_count() - patch.free_count);
    std::iota(last.begin(), last.end(), patch.free_count);
    for (int k = 1; k <= rows; ++k) {
        Indices next;
        for (const int v : last) {
            for (const int w : patch.ring(v).vertices) {
                if (row[w] != none) continue;
                row[w] = k;
                next.push_back(w);
            }
        }
        for (const int v : next) moves.col(v) = share * mean_move(patch, moves, row, v);
        last = std::move(next);
    }
    return moves;
}

// Triangles without a fixed corner whose normal points against the one that they had.
Indices turned_inside(const Patch& patch, const Points& before, const Points& after) {
    Indices result;
    for (int t = 0; t < patch.triangle_count(); ++t) {
        if (patch.triangles.col(t).maxCoeff() >= patch.free_count) continue;
        const auto corners = patch.triangles.col(t);
        if (area_vector(after, corners).dot(area_vector(before, corners)) < 0.0) result.push_back(t);
    }
    return result;
}

}  // namespace

void follow_outline(const Patch& patch, const Points& offsets, Points& points) {
    const Points placed = points;
    Points moves = following(patch, offsets);
    while (true) {
        points = placed + moves;
        const Indices turned = turned_inside(patch, placed, points);
        if (turned.empty()) return;  // at last where none of them moves
        for (const int t : turned) {
            for (const int v : patch.triangles.col(t)) moves.col(v).setZero();
        }
    }
}

}  // namespace fairing
