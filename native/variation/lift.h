// Further points of a surface that is known at the vertices of a mesh, by points and normals.
#pragma once

#include "base/progress.h"
#include "geometry/target_surface.h"
#include "problem/problem.h"
#include "proxy/proxy_mesh.h"
#include "variation/newton.h"
#include "variation/unknowns.h"

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

// Positions (3 × local vertices) near `start` whose edges are about as long as those of the nearest boundary loops:
// edges shorter than 0.8 of that want to be that long, in their present direction, and all others stay as they are.
Points inflated(const Problem& problem, const Points& start, const Progress& progress);

// A state of the mesh, the surface at its vertices, and how the solve there ended.
struct SolvedSheet {
    ProxyMesh::Snapshot mesh;
    Sheet sheet;
    NewtonResult result;
};

// The same boundary on another connectivity, with uniform weights. `patch` must outlive the problem.
Problem on_patch(const Problem& problem, const Patch& patch);

// A solved surface at the vertices of a later state of its mesh.
Sheet resampled(const SolvedSheet& solved, const ProxyMesh::Snapshot& later);

// Minimises on the present state of the mesh, from the last surface or else from the mesh's points, and moves the
// mesh there.
SolvedSheet solve_on(ProxyMesh& mesh, const Problem& problem, const std::optional<SolvedSheet>& last, Measure measure,
                     const NewtonLimits& limits, const Progress& progress);

}  // namespace fairing
