// The tangent plane of a surface at one of its points, from points around it.
#pragma once

#include <optional>
#include <span>

#include "base/types.h"

namespace fairing {

struct SlopeFit {
    Vector3 normal;  // unit
    double error;    // of the slopes: their standard error, and what the last round still changed
};

enum class Degree { quadratic, cubic };

// Fits ⟨d, n⟩ = κ₁ (x² + ⟨d, n⟩²)/2 + b xy + κ₂ y²/2 (and cubic terms) to d = p − centre with tangential coordinates x,
// y along and across the direction that is curved most: a circle there, so that spheres and cylinders are met exactly
// by any points, however far around they reach (chords as in paper eq. 8 do so for spheres). Least squares with
// Gaussian weights; n and the direction are iterated from `start`. Nothing where the points are too few to tell an
// error (6 and 10), don't determine the terms, or lead more than 60° away from `start`.
std::optional<SlopeFit> fit_slopes(const Vector3& centre, std::span<const Vector3> points, const Vector3& start,
                                   Degree degree);

}  // namespace fairing
