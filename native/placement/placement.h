// Where the user's vertices lie on a solved surface.
#pragma once

#include "geometry/target_surface.h"
#include "problem/problem.h"

namespace fairing {

struct Placement {
    std::vector<SurfacePoint> where;  // free vertices of the problem's patch
    Points points;                    // 3 × local vertices
};

// The vertices of a solved surface of the same patch (its target's points) in their places.
Placement at_vertices(const Problem& problem, const TargetSurface& target, const Points& points);

// A placement whose free vertices are at these places.
Placement placed_at(const Problem& problem, const TargetSurface& target, std::vector<SurfacePoint> where);

// Moves one free vertex.
void put(Placement& placement, int vertex, const TargetSurface& target, const SurfacePoint& where);

// Normals of the surface at the free vertices, 3 × free count.
Points normals_at(const Placement& placement, const TargetSurface& target);

// Moves the free vertices by `step` (3 × free count), along the surface.
Placement moved(const Placement& placement, const TargetSurface& target, const Points& step);

// Interpolates a value per vertex of the target's patch at the free vertices; `values` of the fixed ones stay.
VectorX carried_over(const Placement& placement, const TargetSurface& target, const VectorX& values,
                     const Problem& problem);

}  // namespace fairing
