// Step II of the factorisation: vertices move so that they reach a given curvature (paper §7.2, §7.3).
#pragma once

#include "paper/disk_curvature.h"

namespace fairing {

// The input of one vertex update.
struct VertexTarget {
    Vector3 normal;                   // n_i, unit
    std::span<const double> weights;  // of its curvature, see DiskFit
    Vector3 mean;                     // Σ_j λ_ij q_j
    double curvature;                 // H̃_i
    double damping;                   // s
};

// The new position of the disk's centre. First the weighted mean is projected on the tangent plane: q̃ = mean −
// ⟨Δq, n⟩ n. Then it moves by s t n, with H(q̃ + t n) = H̃ for the linearised curvature (eq. 13). t is limited to the
// distance of the neighbours (root mean square). Beyond, the linearisation says nothing.
Vector3 updated_position(const Disk& disk, const DiskField& field, const VertexTarget& target);

}  // namespace fairing
