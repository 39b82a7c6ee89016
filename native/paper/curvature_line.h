// Curvature of a vertex as a linear function of its displacement along the normal (paper §7.2).
#pragma once

#include "geometry/mean_curvature.h"

namespace fairing {

// The fitted second fundamental form is at + t · slope when the vertex moves by t n and the distances to the points
// are held: κ_j(t) = κ_j − 2t/|d_j|². `slope.mean()` is negative.
struct CurvatureLine {
    CurvatureFit at;
    CurvatureFit slope;
};

// The least squares of §6 (eq. 8–11) for both right-hand sides; directions, regularisation and sign as in
// fit_curvature.
CurvatureLine curvature_line(const Vector3& centre, std::span<const Vector3> points, const Vector3& normal);

}  // namespace fairing
