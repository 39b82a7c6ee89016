// A surface within milliseconds: shown while a better one is sought, and kept where there is none.
#pragma once

#include "base/progress.h"
#include "operators/biharmonic_operator.h"
#include "problem/problem.h"

namespace fairing {

// 3 × local vertices, finite. Of a few linear ones that with the least Willmore energy, after two steps of its descent
// (start/globalisation): the clamped bi-Laplacian fill of the boundary by the connectivity alone (start/clamped_fill),
// the one by the shape before, and between several loops that shape low-passed (start/quick_surface). It meets the
// tangent planes given; where the boundary leaves the slope free, those of the shape before. The harmonic map for
// minimal surfaces. Nothing where no system is definite. Throws Cancelled.
std::optional<Points> quick_surface(const Problem& problem, const Progress& progress);

// Positions of all vertices (3 × local vertices). The prescribed normals are continued into the patch as a
// screened harmonic field of unit vectors; the positions are those whose edges are most nearly perpendicular to it.
// Where the membrane of a long pipe necks to a needle, this is the straight pipe. Nothing where the normals cancel.
std::optional<Points> normal_fill(const Problem& problem, const Progress& progress);

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
    // the tangent planes given where these are trusted (start/loft), elsewhere with its own. `wavelengths`,
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
