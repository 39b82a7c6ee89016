// Generalised minimal residuals for operators that are not symmetric (Saad & Schultz 1986).
#pragma once

#include "base/types.h"

namespace fairing {

using LinearMap = std::function<VectorX(const VectorX&)>;

// x with |b − A x| ≤ relative_tolerance · |b|, or the best after `most_steps` steps: right preconditioned by
// `precondition`, from zero, without restart.
VectorX gmres(const LinearMap& apply, const LinearMap& precondition, const VectorX& b, double relative_tolerance,
              int most_steps);

}  // namespace fairing
