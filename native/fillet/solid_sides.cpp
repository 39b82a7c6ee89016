#include "fillet/solid_sides.h"

#include <Eigen/Geometry>

#include "base/progress.h"
#include "fillet/limits.h"
#include "geometry/nearest_point.h"
#include "geometry/segments.h"

namespace fairing {

namespace {

constexpr double tolerated = 0.125;  // of the width: fair surfaces leave their planes by .02 at corners, .1 where they
                                     // fade out or end beside walls; those that leave the shape, by a width
constexpr double felt = 2.0;         // widths: as far from an edge of the other kind a fair surface still follows it

struct BentEdge {
    Vector3 start, end;
    bool convex, concave;  // both, where it is flat
};

std::vector<BentEdge> bent_edges(const Points& points, const Triangles& triangles,
                                 const std::vector<VertexPair>& edges) {
    const SeamMesh mesh(points, triangles, edges, {});
    std::vector<BentEdge> result;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] == none || mesh.twin[h] < h) continue;
        const int other = mesh.twin[h];
        const Vector3 start = points.col(mesh.tail(h));
        const Vector3 offset = Vector3(points.col(mesh.head(h))) - start;
        const Vector3 normal = offset.cross(Vector3(points.col(mesh.tail(SeamMesh::previous(h)))) - start).normalized();
        const Vector3 across = Vector3(points.col(mesh.tail(SeamMesh::previous(other)))) - start;
        const double height = normal.dot(across);
        const double flat = straight_angle * across.norm();
        result.push_back({start, points.col(mesh.head(h)), height<flat, height> - flat});
    }
    return result;
}

}  // namespace

Indices on_wrong_side(const Points& points, const Triangles& triangles, const std::vector<VertexPair>& edges,
                      double width, const FilletPlaces& places) {
    const std::vector<BentEdge> bent = bent_edges(points, triangles, edges);
    const VectorX height = signed_distances(places.after, points, triangles);
    Indices found;
    for (Eigen::Index k = 0; k < height.size(); ++k) {
        checkpoint(static_cast<int>(k));
        if (std::abs(height[k]) <= tolerated * width) continue;
        const bool right = std::any_of(bent.begin(), bent.end(), [&](const BentEdge& edge) {
            return (height[k] < 0.0 ? edge.convex : edge.concave) &&
                   distance_to_segment(places.before.col(k), edge.start, edge.end) <= felt * width;
        });
        if (!right || std::abs(height[k]) > width) found.push_back(static_cast<int>(k));
    }
    return found;
}

}  // namespace fairing
