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

// Keeps the placement with the fewest folds, of those the one with the least merit (tangential_step.h). Where folds
// stay, they are turned back vertex by vertex (placement/untangle).
class Projection {
public:
    Projection(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target)
        : problem_(problem), tangential_(tangential), target_(target) {}

    // True where nothing is folded: no other placement is needed. Vertices that springs have spread:
    bool try_relaxed(Placement placement);
    bool try_as_is(Placement placement);
    [[nodiscard]] Projected best() &&;

private:
    bool keep(Placement placement, Indices folded);

    const Problem& problem_;
    const TangentialStep& tangential_;
    const TargetSurface& target_;
    std::optional<Projected> best_;
    double merit_ = 0.0;
    std::size_t folded_by_springs_ = std::numeric_limits<std::size_t>::max();
};

// By springs from the history of a solved proxy mesh (placement/first_placement), whose last state is `snapshot`, the
// target's; otherwise without them.
Projected place(const Problem& problem, const TangentialStep& tangential, const ProxyMesh& history,
                const ProxyMesh::Snapshot& snapshot, const TargetSurface& target);

// Ends a projected solution as `folded` where the placement is, or where the weights' own minimum has so many folds
// that it says nothing about these vertices.
void refuse_folds(const Problem& problem, const Projected& projected, Solution& solution);

}  // namespace fairing
