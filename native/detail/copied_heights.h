// Skin copied onto a surface, piece by piece.
#pragma once

#include "detail/skin_sample.h"

namespace fairing {

// A smooth surface without skin. Column i belongs to vertex i.
struct BareSurface {
    const Points& points;
    const Points& normals;  // unit
    const Triangles& triangles;
    const VectorX& known;  // heights that are given, NaN elsewhere
};

// Heights for all vertices of the surface: discs of radius `reach` are cut out of the sample, laid on the surface by
// straight distances from their middles, and those laid first stay on top. Blends of two discs keep the variance,
// whatever their correlation. Each place gets the one of some discs that fits best to the heights known there, given or
// laid before. Directions in space are kept. The same input gives the same bits. Precondition: a vertex of the sample
// has `reach` of depth. Throws Cancelled.
VectorX copied_heights(const BareSurface& surface, const SkinSample& sample, double reach);

}  // namespace fairing
