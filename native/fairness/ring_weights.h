// Inner-fairness weights of a single one-ring of M0 (paper §7.3).
#pragma once

#include <vector>

#include "fairness/inner_weights.h"
#include "geometry/vertex_normal.h"

namespace fairing {

// Each writes one weight ≥ 0 for each point of a closed ring, with sum 1. `result` is resized.
// A ring without extent has no weights of its own and gets uniform ones.

// 1/m.
void uniform_ring_weights(std::size_t valence, std::vector<double>& result);

// |q_i − q_j|⁻¹, the weighted least squares of Floater 1997 with r = 1.
void inverse_distance_ring_weights(const OneRing& ring, std::vector<double>& result);

// cot α_j + cot β_j of the angles opposite to each spoke, `apex`-free: both angles lie in the ring. Negative ones
// count as zero: the convex part of the discrete harmonic map.
void conformal_ring_weights(const OneRing& ring, std::vector<double>& result);

// Floater 1997, "Parametrization and smooth approximation of surface triangulations". The ring is laid out in the plane
// with its lengths kept and its angles scaled to sum to 2π. Every point, with the edge of the ring opposite to it,
// gives barycentric coordinates of the centre. These are averaged. Exact on planar rings: Σ λ_j q_j = q_i.
void shape_preserving_ring_weights(const OneRing& ring, std::vector<double>& result);

// By kind; `custom` has no rule for a ring and counts as uniform.
void ring_weights(const OneRing& ring, InnerFairness kind, std::vector<double>& result);

}  // namespace fairing
