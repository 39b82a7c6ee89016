// Patterns of quads laid out on a surface that is known.
#pragma once

#include "geometry/target_surface.h"
#include "quads/candidates.h"

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
struct Effort {
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

// The surface over one boundary loop, flattened to a disc once for all patterns.
class QuadLayout {
public:
    // The arguments must outlive it. Throws SolverError where the surface can't be flattened. Precondition: the patch
    // has one boundary loop, which passes no vertex twice.
    QuadLayout(const Patch& patch, const Points& points, const TargetSurface& surface);

    // Local vertices, the patch on their left; a pattern's boundary is meant in this order.
    [[nodiscard]] const Indices& loop() const { return loop_; }
    [[nodiscard]] HoleBoundary boundary() const;
    // Begins where the pattern's map to the disc with uniform weights (Tutte 1963) and the surface's meet: no quad is
    // turned over there. From there each vertex goes to the mean of the places that the nearest squares and rectangles
    // give it, and back onto the surface.
    [[nodiscard]] LaidOut laid_out(const QuadPattern& pattern, const Effort& effort) const;

private:
    using Flat = Eigen::Matrix2Xd;
    [[nodiscard]] Flat round_boundary() const;
    [[nodiscard]] Flat pattern_on_disc(const QuadPattern& pattern) const;
    void put(LaidOut& laid, int vertex, const SurfacePoint& where) const;
    void mend(LaidOut& laid, const QuadPattern& pattern, int passes) const;
    [[nodiscard]] SurfacePoint located(const Eigen::Vector2d& place) const;
    void sort_triangles();
    [[nodiscard]] std::array<int, 2> bin_of(const Eigen::Vector2d& place) const;

    const Patch& patch_;
    const Points& points_;
    const TargetSurface& surface_;
    Indices loop_;
    Flat disc_;       // of the patch's vertices
    Points normals_;  // of the patch's triangles
    int bins_ = 1;    // along each side of the disc's square
    std::vector<Indices> in_bin_;
};

}  // namespace fairing
