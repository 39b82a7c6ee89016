// The shape that a patch had before, smoothed as far as wanted.
#pragma once

#include <optional>

#include "base/progress.h"
#include "operators/biharmonic_operator.h"
#include "problem/problem.h"

namespace fairing {

// `problem.before` (3 × local vertices), moved with the boundary where that has moved: the displacement is harmonic on
// equilateral triangles. Nothing where no such shape is known, it has no area, or more than a twentieth of its
// triangles are turned over.
std::optional<Points> shape_before(const Problem& problem, const Progress& progress);

// S and M of some shape (3 × local vertices), without the weights and masses of its needles, which drown their
// neighbours'.
Stiffness bounded_stiffness(const Patch& patch, const Points& points);

class ShapeBefore {
public:
    // Nothing where there is no `shape_before`.
    static std::optional<ShapeBefore> of(const Problem& problem, const Progress& progress);

    // 3 × local vertices.
    [[nodiscard]] const Points& points() const { return points_; }

    // The surface x over it for which ∫ |Δx|² + μ |x − points|² is least (Δ and area of the shape before): linear, with
    // the tangent planes given where these are trusted (start/several_outlines), elsewhere with its own. `wavelengths`,
    // of the local vertices, in units of D: μ = (2π / wavelength)⁴, what is much longer stays; infinite: everything is
    // smoothed. Nothing where the system is not definite.
    [[nodiscard]] std::optional<Points> smoothed(const VectorX& wavelengths, const Progress& progress);

private:
    ShapeBefore(const Problem& problem, Points points);

    const Problem& problem_;
    Points points_;
    Stiffness stiffness_;
    Points pull_;  // of its bending, 3 × free vertices
    BiharmonicOperator operator_;
};

}  // namespace fairing
