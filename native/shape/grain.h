// Grain: pores, wrinkles and noise, which turn the normals of a surface everywhere, one way and another.
#pragma once

#include "base/types.h"

namespace fairing {

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

}  // namespace fairing
