// Places the user's vertices on a solved surface by their inner fairness.
#pragma once

#include "geometry/target_surface.h"
#include "proxy/proxy_mesh.h"
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

// Relaxes, weights that aren't symmetric by way of their symmetric part: they have no energy to descend.
double settle(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
              Placement& placement, const Progress& progress);

// The vertices of a solved surface of the same patch (its target's points) in their places.
Placement at_vertices(const Problem& problem, const TargetSurface& target, const Points& points);

// Interpolates a value per vertex of the target's patch at the free vertices; `values` of the fixed ones stay.
VectorX carried_over(const Placement& placement, const TargetSurface& target, const VectorX& values,
                     const Problem& problem);

// The placement whose points are as near to the given ones (3 × local vertices) as a walk gets.
Placement near(const Placement& placement, const TargetSurface& target, const Points& points);

}  // namespace fairing
