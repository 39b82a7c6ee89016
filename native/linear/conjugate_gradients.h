// Preconditioned conjugate gradients over the columns of a field.
#pragma once

#include "base/types.h"

namespace fairing {

// x with A x ≈ r from x = 0, until the residual in the preconditioner's norm has fallen to `relative_tolerance` or
// after `max_cycles`; earlier where A shows itself not to be positive definite. `apply(p)`: A p; `precondition(r)`:
// about A⁻¹ r.
template <typename Apply, typename Precondition>
Points conjugate_gradients(Points r, double relative_tolerance, int max_cycles, const Apply& apply,
                           const Precondition& precondition) {
    const auto inner = [](const Points& a, const Points& b) { return a.cwiseProduct(b).sum(); };
    Points x = Points::Zero(3, r.cols());
    Points z = precondition(r);
    Points p = z;
    double rz = inner(r, z);
    const double target = relative_tolerance * relative_tolerance * rz;
    for (int cycle = 0; cycle < max_cycles && rz > target; ++cycle) {
        const Points Ap = apply(p);
        const double curvature = inner(p, Ap);
        if (!(curvature > 0.0)) break;
        const double alpha = rz / curvature;
        x += alpha * p;
        r -= alpha * Ap;
        z = precondition(r);
        const double next = inner(r, z);
        p = z + (next / rz) * p;
        rz = next;
    }
    return x;
}

}  // namespace fairing
