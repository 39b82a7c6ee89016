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

    // Starts from the composition of the pattern's flat map and the surface's, which turns no quad over. Then each
    // vertex moves to the mean of its positions in the closest squares and rectangles, and is projected.
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

// How far quads are from squares, and steps that bring them there.
inline constexpr double most_wide = 175.0;  // degrees: short of a quad that is not convex

inline bool is_unfit(double angle) { return angle < 50.0 || angle > 130.0; }

template <typename Face>
Vector3 normal_at(const Face& face, const Points& normals) {
    Vector3 sum = Vector3::Zero();
    for (const int v : face) sum += normals.col(v);
    return sum.normalized();
}

// Degrees from the edge to `next` counter-clockwise to that to `last`, 0 … 360, seen from where the normal points.
double angle_of_corner(const Vector3& last, const Vector3& here, const Vector3& next, const Vector3& normal);

// Deviation from a right angle, in units of 45°.
double angle_error(double angle);

// Quality of all quads of a pattern at these positions; the surface's `normals` there show which are turned over.
// `length`: the target length of edges.
QuadShapes shapes_of(const QuadPattern& pattern, const Points& points, const Points& normals, double length);

// Moves vertices so that quads become squares, or rectangles at least: to the mean of their positions in the closest
// such shapes (Bouaziz et al. 2012, shape constraints). Each step adds momentum from the last one.
class SquareSteps {
public:
    explicit SquareSteps(const QuadPattern& pattern) : pattern_(pattern) {}
    // New positions; those of the boundary are unchanged.
    Points wanted(const Points& points, const Points& normals);

private:
    const QuadPattern& pattern_;
    Points last_;
};

}  // namespace fairing
