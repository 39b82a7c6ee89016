// The user's vertices on the surface of a proxy, by their inner fairness and without folds.
#pragma once

#include "geometry/target_surface.h"
#include "problem/problem.h"
#include "problem/solution.h"
#include "proxy/proxy_mesh.h"
#include "tangential/tangential_step.h"

namespace fairing {

// Where the user's vertices lie on a solved surface.
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

struct Projected {
    Placement placement;
    Indices folded;                     // triangles of the problem's patch that no placement turned back
    std::size_t folded_by_springs = 0;  // triangles that the least folded minimum of the springs alone turns over
};

// The surface of a mesh of the engine's own. The members outlive it.
struct OwnMeshSurface {
    const ProxyMesh& history;  // the vertices and how they came to be
    const ProxyMesh::Snapshot& mesh;
    const TargetSurface& target;
};

// Tries several placements and takes the one with the fewest folds, then with the least merit (tangential_step.h). They
// begin from `guess`, a surface of the problem's own patch that has the right sheets, and from the history of the proxy
// mesh (placement/first_placement). Where the springs' minimum is folded, folds are turned back vertex by vertex.
Projected place(const Problem& problem, const TangentialStep& tangential, const OwnMeshSurface& surface,
                const std::optional<Points>& guess);

// The same from vertices that springs have spread already.
Projected project_relaxed(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
                          Placement relaxed);

// Ends a projected solution as `folded` where the placement is, or where the weights' own minimum has so many folds
// that it says nothing about these vertices.
void refuse_folds(const Problem& problem, const Projected& projected, Solution& solution);

}  // namespace fairing
