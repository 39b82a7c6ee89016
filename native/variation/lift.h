// Further points of a surface that is known at the vertices of a mesh, by points and normals.
#pragma once

#include "geometry/target_surface.h"
#include "variation/sheet.h"
#include "variation/stencil.h"

namespace fairing {

struct SurfaceSample {
    Vector3 point;
    Vector3 normal;
};

// The sample near a point of the curved triangles of `target` (of the same sheet) that fits the triangle's neighbours:
// along the pairs from it to the vertices of the stencil the normal curvature changes as along those of the triangle.
// Exact on planes, spheres and circular cylinders; elsewhere as good as the curved triangles.
class Lift {
public:
    // The arguments must outlive the lift.
    Lift(const Patch& patch, const Sheet& sheet);
    [[nodiscard]] SurfaceSample sample(const TargetSurface& target, const SurfacePoint& where) const;

private:
    const Sheet& sheet_;
    std::vector<Stencil> stencils_;
};

}  // namespace fairing
