// A solved mesh as a smooth surface onto which other vertices are projected.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Where a point lies on a triangle mesh.
struct SurfacePoint {
    int triangle = 0;
    Vector3 weights = Vector3(1.0, 0.0, 0.0);  // barycentric, ≥ 0
};

// Curved PN triangles (Vlachos et al. 2001) over a patch with unit normals at its vertices; triangles between vertices
// with zero normals are flat.
class TargetSurface {
public:
    // The arguments must outlive the surface. Columns: local vertices of the patch. `walls`: edges that no walk
    // crosses, one entry for each; empty: none but the border.
    TargetSurface(const Patch& patch, const Points& points, const Points& normals, std::vector<char> walls = {});

    // The point of the mesh near `position` that a walk from `start` reaches. It goes across edges towards the foot of
    // the perpendicular, never over the border or a wall. Where folded triangles make it cycle, it takes the nearest
    // point of those around. The walk is local: a surface that comes close to itself does not confuse it.
    [[nodiscard]] SurfacePoint project(const Vector3& position, int start) const;

    [[nodiscard]] Vector3 position(const SurfacePoint& where) const;
    [[nodiscard]] Vector3 normal(const SurfacePoint& where) const;
    // Unit normal of a flat triangle of the mesh; zero where it has no area.
    [[nodiscard]] Vector3 face_normal(int triangle) const;
    // Linear interpolation of a value per vertex.
    [[nodiscard]] double interpolate(const VectorX& values, const SurfacePoint& where) const;
    [[nodiscard]] int vertex_count() const { return static_cast<int>(points_.cols()); }
    // A vertex as a point of the last one of its triangles.
    [[nodiscard]] SurfacePoint at_vertex(int vertex) const;

private:
    [[nodiscard]] int across(int edge, int triangle) const;
    [[nodiscard]] Vector3 flat_normal(int triangle) const;
    [[nodiscard]] SurfacePoint nearest_around(const Vector3& position, int start) const;

    const Patch& patch_;
    const Points& points_;
    const Points& normals_;
    std::vector<char> walls_;
};

}  // namespace fairing
