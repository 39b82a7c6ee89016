// Normals of neighbouring fits reconciled along an outline.
#pragma once

#include "outline/surrounding_fit.h"

namespace fairing {

// The n_i (3 × k, unit) that minimise Σ |n_i − n̂_i|²/σ_i² + μ Σ |n_i − n_j − g_ij|²/(σ_i σ_j + δ_ij²) over the
// outline's edges: n̂ and σ are the fits' normals and standard errors, g_ij the mean of the turns from j to i that both
// fits predict, δ_ij how far these two are apart (a crease, or a surface that the fits don't follow). So nothing turns
// where the fits agree, whatever the curvature. The averaged normals where there is no fit.
Points filtered_normals(const SurroundingFit& fit);

}  // namespace fairing
