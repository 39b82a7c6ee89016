// A surface without its roughness: what is shorter than a wavelength goes, what is longer stays.
#pragma once

#include "base/progress.h"
#include "base/types.h"

namespace fairing {

struct NoisySurface {
    const Points& points;        // 3 × n
    const Triangles& triangles;  // those of the vertices that move, and around these
    const Indices& fixed;        // vertices that stay
};

// The b with the least Σ A |b − x|² + l⁴ |Δ b|² A, once for x and once more for what was left of it. `sizes` (n): waves
// as long as that lose 1 % of their height, longer ones less, those of .46 of it one half; 0 where the surface may
// bend: at a border, an edge. 3 × n; vertices that are fixed, or have no area, keep their bits. Throws SolverError,
// Cancelled.
Points denoised(const NoisySurface& surface, const VectorX& sizes, const Progress& progress);

}  // namespace fairing
