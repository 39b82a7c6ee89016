// Which border loops are holes, and how much surface a loop asks for.
#pragma once

#include "base/types.h"

namespace fairing {

// A closed loop with the new surface on its left: columns of both in its order.
struct LoopShape {
    Points points;
    Points normals;  // unit
    // The triangles' angles at each vertex, in radians, less π: how far the loop turns to the right there, seen from
    // the mesh. Empty where no triangle holds it.
    VectorX angles = {};

    [[nodiscard]] int size() const { return static_cast<int>(points.cols()); }
    [[nodiscard]] auto edge(int k) const { return points.col((k + 1) % size()) - points.col(k); }
    [[nodiscard]] double perimeter() const;
};

// A surface so many times as large as a flat one is out of proportion: more of a ball than a 25° cap leaves open.
inline constexpr double out_of_proportion = 20.0;

// The geodesic curvature of a loop added up, over 2π: 1 around a hole in a plane, 0 at the end of a tube, −1 around the
// outside of a sheet, however that is bent along one direction. In the tangent planes where the triangles' own angles
// are nowhere far from that; else by these, whose sum triangles that stand up from the surface don't change (noise
// does).
double turning(const LoopShape& loop);

// How many times as large as a flat disc the cap of a ball over a loop is: 1 over a plane, 2 over a tube's end. By
// Gauss-Bonnet a disc over a loop with the turning τ bends by 2π (1 − τ), and a ball's cap is 2 / (1 + τ) times as
// large as the flat disc.
double times_flat(const LoopShape& loop);

// Whether it goes around the outside of a sheet; of a flat one, which nothing closes.
bool is_outer(const LoopShape& loop);
bool is_endless(const LoopShape& loop);

// About how many new vertices flat surfaces over the loops have; `joined`: bands between them. `spacing`: of the edges,
// 0: as the loops' own in the mean.
double flat_count(std::span<const LoopShape> loops, double spacing, bool joined);

// About how many surfaces over loops have: within some per cent over parts of planes, tubes and balls with even edges,
// within a factor of two or so over others.
double expected_count(std::span<const LoopShape> loops, double spacing, bool joined);

// About how many a surface over a loop has at least: as `flat_count`, but around the outside of a sheet goes a ball
// that bends as its normals do, in the direction in which they do most.
double least_count(const LoopShape& loop, double spacing);

// Some of so many places, evenly: as many as are compared with each other in no time.
Indices spread(int count);

// Whether the surface on the left of a loop without triangles would lie outside of it, and be no ball either.
bool leads_outside(const LoopShape& loop);

}  // namespace fairing
