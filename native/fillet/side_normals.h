// What the sides of a seam are like, each by itself.
#pragma once

#include "fillet/seam_mesh.h"

namespace fairing {

// Normals and mean curvatures of the triangles that no seam and no wall part from a place. Where the triangles around a
// vertex lie in a plane, or none of them has an inner vertex of its side, they alone decide (a strip's own faces say
// how it runs on, while its borders fit many surfaces); elsewhere a surface is fitted.
class SideNormals {
public:
    // `parted`: seams and walls. Keeps a reference to the mesh.
    SideNormals(const SeamMesh& mesh, const std::vector<VertexPair>& parted);

    // Finds them at the corners of these triangles. Asks whether to stop.
    void find_at(const Indices& triangles);

    // In one of these triangles, with barycentric weights: a unit normal, and H in length⁻¹; where no surface was
    // fitted H = −½ div n of the normals at the triangle's corners. NaN in a triangle without area.
    [[nodiscard]] Vector3 normal(int triangle, const Vector3& weights) const;
    [[nodiscard]] double curvature(int triangle, const Vector3& weights) const;

private:
    [[nodiscard]] Vector3 face_normal(int triangle) const;
    [[nodiscard]] double divergence(int triangle) const;
    void mark_inner();
    void average();

    const SeamMesh& mesh_;
    Triangles copies_;  // the triangles, of vertices with a copy on each side
    Points points_;     // of the copies
    Points normals_;
    VectorX curvatures_;
    std::vector<char> known_;  // whether those are final
    std::vector<char> fits_;   // whether a fit tells more than the triangles around
};

}  // namespace fairing
