// Places the user's vertices on a solved surface by their inner fairness.
#pragma once

#include "proxy/proxy_mesh.h"
#include "geometry/target_surface.h"
#include "solver/problem.h"
#include "solver/tangential_step.h"

namespace fairing {

struct Placement {
    std::vector<SurfacePoint> where;  // free vertices of the problem's patch
    Points points;                    // 3 × local vertices
};

// First guess: removed vertices come back in reverse order, each at the mean of the ring that it left; the others are
// vertices of the target, whose patch is the last snapshot of the proxy mesh.
Placement first_placement(const Problem& problem, const ProxyMesh& mesh, const ProxyMesh::Snapshot& snapshot,
                          const TargetSurface& target);

// Minimises Σ λ_ij |x_i − x_j|² on the surface: tangential conjugate gradient steps, each followed by a walk back to
// the surface, accelerated, shortened until the sum no longer grows. Gives the merit that is reached
// (tangential_step.h).
double relax(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
             Placement& placement);

// The placement whose points are as near to the given ones (3 × local vertices) as a walk gets.
Placement near(const Placement& placement, const TargetSurface& target, const Points& points);

}  // namespace fairing
