// How the curvature of a 1-disk (paper §6) changes when its vertex moves (§7.2).
#pragma once

#include "base/types.h"

namespace fairing {

// w_j of H = Σ_j w_j κ_j (eq. 10, 11) for the directions from `centre` to the points around it: those of fit_curvature.
void curvature_weights(const Vector3& centre, std::span<const Vector3> around, const Vector3& normal,
                       std::span<double> weights);

// The input of one vertex update.
struct VertexTarget {
    Vector3 normal;                   // n_i, unit
    std::span<const double> weights;  // w_j: they belong to the directions alone, which stay along the normal
    Vector3 mean;                     // Σ_j λ_ij q_j
    double curvature;                 // H̃_i
    double damping;                   // s
};

// The new position of a vertex. First the weighted mean is projected on the tangent plane: q̃ = mean − ⟨Δq, n⟩ n. Then
// it moves by s t n, with H(q̃ + t n) = H̃ for the linearised curvature (eq. 13: κ_j(t) = κ_j − 2t/|d_j|²). t is limited
// to the distance of the points around (root mean square). Beyond, the linearisation says nothing.
Vector3 updated_position(const Vector3& present, std::span<const Vector3> around, const VertexTarget& target);

}  // namespace fairing
