#include "geometry/flips.h"

#include "geometry/vertex_normal.h"

namespace fairing {

Indices flipped_triangles(const Patch& patch, const Points& points) {
    FaceGeometry faces;
    faces.update(points, patch.triangles);
    const Points no_normals = Points::Zero(3, patch.vertex_count() - patch.free_count);
    const Points normals = max_normals(patch, points, no_normals);
    Indices flipped;
    for (int t = 0; t < patch.triangle_count(); ++t) {
        Vector3 around = Vector3::Zero();
        for (int v : patch.triangles.col(t)) around += normals.col(v);
        if (around.dot(faces.normals.col(t)) < 0.0) flipped.push_back(t);
    }
    return flipped;
}

Indices flipped_by_solution(const Patch& patch, const Points& points) {
    Indices flipped = flipped_triangles(patch, points);
    std::erase_if(flipped, [&](int t) { return patch.triangles.col(t).minCoeff() >= patch.free_count; });
    return flipped;
}

}  // namespace fairing
