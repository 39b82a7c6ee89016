// Patterns of quads laid out on a surface that is known.
#pragma once

#include "quads/flat_map.h"

namespace fairing {

// How good the quads of a pattern are.
struct QuadShapes {
    double angle_error = 0.0;  // mean square of the differences of their angles from 90°, in units of 45°
    double size_error = 0.0;   // mean square of the logarithm of their edges over those of the boundary near by
    double unfit = 0.0;        // share of the angles below 50° or above 130°
    double widest = 0.0;       // degrees
    double concave = 0.0;      // share of the quads that are not convex, or nearly so
};

// How long vertices are moved: together, and then one by one around angles that are still unfit.
struct Relaxation {
    int sweeps = 0;
    int passes = 0;
};

// A pattern on the surface: its boundary, then its new vertices.
struct LaidOut {
    Points points;
    Points normals;                   // of the surface there
    std::vector<SurfacePoint> where;  // of the new vertices
    QuadShapes shapes;
};

class QuadLayout {
public:
    // The arguments must outlive it.
    QuadLayout(const FlatMap& map, const Patch& patch, const Points& points, const TargetSurface& surface);

    // Begins where the pattern's map and the surface's meet: no quad is turned over there. From there each vertex goes
    // to the mean of the places that the nearest squares and rectangles give it, and back onto the surface.
    [[nodiscard]] LaidOut laid_out(const QuadPattern& pattern, const Relaxation& effort) const;

private:
    void put(LaidOut& laid, int vertex, const SurfacePoint& where) const;
    void mend(LaidOut& laid, const QuadPattern& pattern, int passes) const;

    const FlatMap& map_;
    const Patch& patch_;
    const Points& points_;
    const TargetSurface& surface_;
    Indices rim_;         // the boundary's local vertices, loop after loop
    Points normals_;      // of the patch's triangles,
    Points rim_normals_;  // and their means at the boundary: those that it is to have may lean far from them
};

}  // namespace fairing
