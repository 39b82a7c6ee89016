#include "shape/roughness.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "geometry/triangle.h"
#include "mesh/edges.h"
#include "shape/limits.h"

namespace fairing {

namespace {

constexpr int rings_around = 4;  // as far as fits of slopes reach

using Marks = std::vector<char>;

Marks corners(const Triangles& triangles, Eigen::Index vertex_count) {
    Marks found(static_cast<std::size_t>(vertex_count), 0);
    for (const int v : triangles.reshaped()) found[v] = 1;
    return found;
}

// Vertices within some rings of the marked ones, these among them.
void grow(const EdgeTable& edges, int rings, Marks& marked) {
    for (int ring = 0; ring < rings; ++ring) {
        Marks next = marked;
        for (const auto& [a, b] : edges.ends) {
            if (marked[a]) next[b] = 1;
            if (marked[b]) next[a] = 1;
        }
        marked = std::move(next);
    }
}

// At an open border heights say nothing.
void unmark_border(const EdgeTable& edges, Marks& marked) {
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) == 1) marked[edges.ends[e][0]] = marked[edges.ends[e][1]] = 0;
    }
}

std::vector<double> marked_heights(const Points& points, const Triangles& triangles, const std::vector<char>& marked) {
    const VectorX all = heights(points, triangles);
    std::vector<double> found;
    for (Eigen::Index v = 0; v < all.size(); ++v) {
        if (marked[static_cast<std::size_t>(v)] && std::isfinite(all[v])) found.push_back(all[v]);
    }
    return found;
}

}  // namespace

VectorX heights(const Points& points, const Triangles& triangles) {
    // In a closed ring of triangles each neighbour counts twice, and so does not matter.
    Points sums = Points::Zero(3, points.cols());
    VectorX lengths = VectorX::Zero(points.cols());
    VectorX uses = VectorX::Zero(points.cols());
    for (const auto corner : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const Vector3 left = points.col(corner[(k + 1) % 3]);
            const Vector3 right = points.col(corner[(k + 2) % 3]);
            sums.col(corner[k]) += 0.5 * (left + right);
            lengths[corner[k]] += (left - right).norm();
            uses[corner[k]] += 1.0;
        }
    }
    VectorX result = VectorX::Zero(points.cols());
    for (Eigen::Index v = 0; v < result.size(); ++v) {
        if (lengths[v] != 0.0) result[v] = (points.col(v) * uses[v] - sums.col(v)).norm() / lengths[v];
    }
    return result;
}

bool is_spoilt(const Points& points, const Triangles& inside, const Triangles& outside) {
    std::vector<char> own = corners(inside, points.cols());
    std::vector<char> around = corners(outside, points.cols());
    for (std::size_t v = 0; v < own.size(); ++v) {
        const bool is_border = own[v] && around[v];
        own[v] = own[v] && !is_border;
        around[v] = is_border;
    }
    std::vector<double> found = marked_heights(points, inside, own);
    if (found.empty()) return false;
    if (*std::max_element(found.begin(), found.end()) > spike) return true;
    const double height = median(found);
    if (height < crumpled) return false;
    const EdgeTable edges = make_edges(outside, static_cast<int>(around.size()));
    grow(edges, rings_around, around);
    unmark_border(edges, around);
    std::vector<double> others = marked_heights(points, outside, around);
    return others.empty() || height > rougher * median(others);
}

}  // namespace fairing
