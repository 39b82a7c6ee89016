#include "geometry/flips.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "geometry/cotangent.h"
#include "geometry/one_ring_buffer.h"
#include "mesh/corners.h"

namespace fairing {

namespace {

// A triangle as flat as FaceGeometry gives no normal for is not turned over. The cross product is of its edges.
bool has_normal(const Vector3& cross, const Vector3& first, const Vector3& second) {
    const double longest = std::max({first.squaredNorm(), second.squaredNorm(), (second - first).squaredNorm()});
    return cross.norm() > least_twice_area * longest;
}

bool is_turned(const Points& points, const Points& normals, const Eigen::Vector3i& corners) {
    const Vector3 around = normals.col(corners[0]) + normals.col(corners[1]) + normals.col(corners[2]);
    const Vector3 first = points.col(corners[1]) - points.col(corners[0]);
    const Vector3 second = points.col(corners[2]) - points.col(corners[0]);
    const Vector3 cross = first.cross(second);
    return around.dot(cross) < 0.0 && has_normal(cross, first, second);
}

}  // namespace

Indices flipped_triangles(const Patch& patch, const Points& points) {
    const Points no_normals = Points::Zero(3, patch.vertex_count() - patch.free_count);
    const Points normals = max_normals(patch, points, no_normals);
    std::vector<char> turned(patch.triangle_count());
    for_ranges(patch.triangle_count(), coarse_grain, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) turned[t] = is_turned(points, normals, patch.triangles.col(t));
    });
    Indices flipped;
    for (int t = 0; t < patch.triangle_count(); ++t) {
        if (turned[t]) flipped.push_back(t);
    }
    return flipped;
}

Indices flipped_by_solution(const Patch& patch, const Points& points) {
    return with_free_corner(patch, flipped_triangles(patch, points));
}

bool is_flipped(const Patch& patch, const Points& points, int triangle) {
    const auto corners = patch.triangles.col(triangle);
    Vector3 around = Vector3::Zero();
    OneRingBuffer buffer;
    for (const int v : corners) {
        if (patch.is_free(v) || patch.pin[v]) around += max_normal(buffer.gather(patch, points, v));
    }
    const Vector3 first = points.col(corners[1]) - points.col(corners[0]);
    const Vector3 second = points.col(corners[2]) - points.col(corners[0]);
    return around.dot(first.cross(second)) < 0.0;
}

}  // namespace fairing
