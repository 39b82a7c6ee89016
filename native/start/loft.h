// A linear surface between several boundary loops, straight from one to the next.
#pragma once

#include "base/progress.h"
#include "operators/biharmonic_operator.h"
#include "operators/normal_operator.h"
#include "problem/problem.h"
#include "start/clamped_fill.h"

namespace fairing {

class Loft {
public:
    // Factorised for the patch's connectivity and the longest boundary loop of `problem`. `roundness`: the middle of a
    // straight tube without slopes has its radius divided by cosh(roundness / 2); a larger one damps ripples of the
    // boundary sooner. Two boundary loops joined by an edge are one loop, and no direction is preferred. Nothing for a
    // single loop, or with vertices held elsewhere.
    static std::optional<Loft> of(const Problem& problem, double roundness, const Progress& progress);

    // For the boundary of that patch. `flat`: lines from the longest loop to the others. `bulge`: what the boundary's
    // tangent planes add, less where the given normals turn by more than 30° along the boundary, and nothing beyond
    // 60°.
    [[nodiscard]] Fill over(const Problem& problem) const;

private:
    explicit Loft(const Patch& patch);

    Stiffness stiffness_;
    std::unique_ptr<LaplaceOperator> laplace_;
    std::unique_ptr<BiharmonicOperator> clamped_;
};

// Whether the patch lies between several boundary loops, of which two joined by an edge are one loop, and nothing is
// held elsewhere.
bool joins_boundaries(const Problem& problem);

// Relative length of a patch between two boundary loops: the area of the straight tube between them over the sum of
// their squared lengths, L / 4π for a pipe of L radii; 0 between more or fewer. `points`: 3 × local vertices, of which
// the fixed ones count.
double straight_length_between(const Patch& patch, const Points& points);

// Up to this length one surface fits between two boundary loops (a pipe of two and a half radii); two fit a pipe from
// 2π radii on.
inline constexpr double longest_single = 0.2;

// Whether several surfaces may fit between the boundary loops, by one that does (3 × local vertices).
bool may_fit_several(const Patch& patch, const Points& points);

// How far the slope at each fixed vertex is trusted: 1 where the given normals turn by less than 30° along the
// boundary, less and less up to 60°, 0 beyond.
VectorX trust_in_slopes(const Problem& problem);

}  // namespace fairing
