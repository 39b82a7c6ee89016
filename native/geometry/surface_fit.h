// Surfaces fitted to nearby vertices: for boundary loops, where the one-ring sees one side only.
#pragma once

#include "base/direction.h"
#include "geometry/neighbourhood.h"
#include "geometry/slope_fit.h"
#include "mesh/patch.h"

namespace fairing {

// The best fits at vertices of a surface formed by triangles. Where the centres are met, four fits of up to three rings
// compete; where they are free, fits of up to four rings and the 40 nearest vertices do, too, against noise, and a
// strip's fit stands in where these do not determine a quadric.
class SurfaceFits {
public:
    // Coordinates beyond ±1e100 or within ±1e-100 lose their digits: scale them. Keeps references.
    SurfaceFits(const Points& points, const Triangles& triangles, Centre at_centres);

    // The fit whose slopes have the least standard error, with the curvature of the fit that has the least standard
    // error of that; nothing where the points are too few.
    std::optional<SlopeFit> at_vertex(int vertex) { return at_vertex(vertex, around_); }
    // The same with the caller's own walk, for loops on several threads.
    std::optional<SlopeFit> at_vertex(int vertex, Neighbourhood& around) const;
    [[nodiscard]] Neighbourhood walk() const { return {adjacency_, points_, reach_of(at_centres_)}; }
    // The normalised sum of the adjacent triangles' cross products; zero where there are none.
    [[nodiscard]] Vector3 averaged(int vertex) const { return direction(summed_.col(vertex)); }

private:
    [[nodiscard]] std::optional<SlopeFit> strip_at(int vertex, const Neighbourhood& around) const;
    static Reach reach_of(Centre at_centres);

    const Points& points_;
    VertexAdjacency adjacency_;
    Neighbourhood around_;
    Points summed_;  // cross products
    Centre at_centres_;
};

// Coordinates of the triangles' corners divided by `size`, the largest of them: no product of edges is infinite, and
// none is lost to denormals.
struct UnitSized {
    Points points;
    double size;
};
UnitSized to_unit_size(const Points& points, const Triangles& triangles);

// Normals at the fixed vertices (3 × fixed count) of the surface through them that fits the patch's own side of the
// boundary; averaged ones where the fit has too few points.
Points one_sided_normals(const Patch& patch, const Points& points);

}  // namespace fairing
