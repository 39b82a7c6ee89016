#include "shape/needles.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "geometry/angle.h"
#include "geometry/area_vector.h"
#include "mesh/edges.h"
#include "shape/limits.h"

namespace fairing {

namespace {

bool is_needle(const Points& points, const Triangles& triangles, Eigen::Index t) {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
        const Vector3 side = points.col(triangles((k + 1) % 3, t)) - points.col(triangles(k, t));
        longest = std::max(longest, side.squaredNorm());
    }
    return !(area_vector(points, triangles.col(t)).norm() > needle_height * longest);
}

// Of the triangles on the other sides of a triangle's edges.
std::vector<Vector3> normals_beside(const Points& points, const Triangles& triangles, const EdgeTable& edges, int t) {
    std::vector<Vector3> normals;
    for (int k = 0; k < 3; ++k) {
        const int edge = edges.edge_of_side[3 * t + k];
        for (int side = 0; side < edges.side_count(edge); ++side) {
            const int other = edges.side(edge, side) / 3;
            if (other != t) normals.push_back(area_vector(points, triangles.col(other)));
        }
    }
    return normals;
}

bool bends(const std::vector<Vector3>& normals) {
    for (std::size_t k = 1; k < normals.size(); ++k) {
        for (std::size_t j = 0; j < k; ++j) {
            if (degrees_between(normals[j], normals[k]) > flat_bend) return true;
        }
    }
    return false;
}

}  // namespace

Needles needles(const Points& points, const Triangles& triangles) {
    Needles found;
    for (int t = 0; t < triangles.cols(); ++t) {
        if (is_needle(points, triangles, t)) found.all.push_back(t);
    }
    if (found.all.empty()) return found;
    const EdgeTable edges = make_edges(triangles, static_cast<int>(points.cols()));
    for (const int t : found.all) {
        if (bends(normals_beside(points, triangles, edges, t))) found.seen.push_back(t);
    }
    return found;
}

}  // namespace fairing
