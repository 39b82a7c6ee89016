// The edge of a rough surface without its roughness.
#pragma once

#include "base/progress.h"
#include "base/types.h"

namespace fairing {

// At vertices on the edge of a surface.
struct LowPass {
    Points points;            // 3 × k; the given one where nothing was found
    Points normals;           // 3 × k, unit, likewise zero
    std::vector<char> found;  // per vertex
};

// Places and normals at `vertices` (each on the edge of the surface that `triangles` form, or within it) of that
// surface without what repeats within less than `wavelength`, in units of the points. Spheres and quadrics are fitted a
// quarter of a wavelength apart, over reaches from half a wavelength to two; each place takes the fit with the most
// certain normal among those that no less certain one contradicts (Lepski 1990): wide fits where the curvature is
// constant, narrow ones elsewhere. Each vertex takes the mean of the fits around it. Throws Cancelled.
LowPass low_pass(const Points& points, const Triangles& triangles, const Indices& vertices, double wavelength);

// A surface without its roughness: what is shorter than a wavelength goes, what is longer stays.
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
