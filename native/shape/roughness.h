// Surfaces whose own shape is no texture to keep: a vertex was pulled far out, or all of it is crumpled.
#pragma once

#include "base/types.h"

namespace fairing {

// How far each vertex is from the mean of its neighbours, in mean lengths of the edges opposite to it; 0 in no
// triangle, and where these edges have no length.
VectorX heights(const Points& points, const Triangles& triangles);

// Whether a vertex that only triangles inside have is higher than `spike`, or whether the median of these is above
// `crumpled` and `rougher` times that of the vertices around, those within four rings of the boundary (shape/limits).
bool is_spoilt(const Points& points, const Triangles& inside, const Triangles& outside);

// A mesh around the outline of a patch, as it was and as it is.
struct Smoothed {
    Points before;
    Points after;
    Triangles inside;
    Triangles outside;
};

// Whether the patch had the grain of its surroundings, and has it no more. Grain is what is seen (seen_grain) and
// evenly spread: features turn the normals here much and there hardly (even_grain; shape/limits).
bool has_lost_grain(const Smoothed& mesh);

// Whether the inside is crumpled: many of its edges (crumpled_share) bend beyond the range of nine tenths of those
// outside, and by more than a kink that may be seen (finest_kink).
bool is_rougher(const Points& points, const Triangles& inside, const Triangles& outside);

// Triangles without a height.
struct Needles {
    Indices all;   // triangles whose height is below `needle_height` of their longest side; ascending
    Indices seen;  // those between neighbours that bend by more than `flat_bend`: on a plane no one sees them
                   // (shape/limits)
};

// Of any triangles; a corner that isn't finite makes one.
Needles needles(const Points& points, const Triangles& triangles);

}  // namespace fairing
