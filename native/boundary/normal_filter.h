// Normals of neighbouring fits reconciled along a boundary.
#pragma once

#include "boundary/surrounding_fit.h"

namespace fairing {

// The n_i (3 × k, unit) that minimise Σ |n_i − n̂_i|²/σ_i² + μ Σ |n_i − n_j − g_ij|²/(σ_i σ_j + δ_ij²) over the
// boundary's edges. n̂ and σ are the fits' normals and standard errors. g_ij is the mean of the turns from j to i that
// both fits predict. δ_ij is how far these two are apart: at a crease, or where the fits don't follow the surface.
// Normals stay where the fits agree, whatever the curvature. Where there is no fit the averaged normal stays.
Points filtered_normals(const SurroundingFit& fit);

}  // namespace fairing
