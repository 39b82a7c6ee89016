// A linear surface between several boundary loops, straight from one to the next.
#pragma once

#include <memory>
#include <optional>

#include "base/progress.h"
#include "operators/biharmonic_operator.h"
#include "operators/laplace_operator.h"
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

}  // namespace fairing
