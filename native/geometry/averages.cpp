#include "geometry/averages.h"

#include "base/direction.h"
#include "geometry/face_geometry.h"

namespace fairing {

Points averaged_normals(const Points& points, const Triangles& triangles) {
    Points normals = summed_normals(points, triangles);
    for (auto normal : normals.colwise()) normal = direction(Vector3(normal));
    return normals;
}

double mean_edge(const Patch& patch, const Points& points) {
    double sum = 0.0;
    for (const auto& [a, b] : patch.edge_ends) sum += (points.col(a) - points.col(b)).norm();
    return sum / patch.edge_count();
}

double mean_spoke(const Patch& patch, const Points& points, int vertex) {
    const auto ring = patch.ring(vertex).vertices;
    double sum = 0.0;
    for (const int w : ring) sum += (points.col(w) - points.col(vertex)).norm();
    return sum / static_cast<double>(ring.size());
}

}  // namespace fairing
