// Linear systems that need not be symmetric.
#pragma once

#include "linear/anderson.h"

namespace fairing {

// x with |b − A x| ≤ relative_tolerance · |b|, from zero, or the last one after `most_steps`. `apply`: A; the steps
// M (b − A x) of `precondition`, M, are accelerated, which does what GMRES does (Walker & Ni 2011).
template <typename Apply, typename Precondition>
VectorX solve_by_steps(const Apply& apply, const Precondition& precondition, const VectorX& b,
                       double relative_tolerance, int most_steps) {
    constexpr int depth = 20;  // more than such a solve takes steps
    Anderson anderson(depth);
    VectorX x = VectorX::Zero(b.size());
    VectorX left = b;
    for (int k = 0; k < most_steps && left.norm() > relative_tolerance * b.norm(); ++k) {
        x += anderson.step(x, precondition(left));
        left = b - apply(x);
    }
    return x;
}

}  // namespace fairing
