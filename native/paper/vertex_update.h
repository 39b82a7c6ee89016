// Step II of the factorisation: vertices move so that they get the curvature wanted (paper §7.2, §7.3).
#pragma once

#include "paper/disk_geometry.h"

namespace fairing {

// What one update needs to know of its vertex.
struct VertexTarget {
    Vector3 mean;      // Σ_j λ_ij q_j
    double curvature;  // H̃_i
    double damping;    // s
    bool completed;    // whether virtual points join the fit
};

// The new position of the disk's centre: the projection of the weighted mean on the tangent plane, q̃ = mean −
// ⟨Δq, n⟩ n, then s t n with H(q̃ + t n) = H̃ for the linearised curvature (eq. 13). t is limited to the mean distance of
// the neighbours, beyond which the linearisation says nothing. `normal`: the vertex's own, of unit length.
Vector3 updated_position(const Disk& disk, const Points& points, const Vector3& normal, const VertexTarget& target,
                         DiskCurvature& curvature);

}  // namespace fairing
